#pragma once
// The sums of a block's pixels by the blur of their lens cells (plan/lens_cells.h), and the block's image with each
// class of them blurred.
//
// The classes are laid over each other from the farthest to the nearest: behind the focus what is more blurred is
// farther, in front of it what is more blurred is nearer, and what is sharp lies between. Each is blurred among the
// samples that show nothing nearer. So a sharp outline stays sharp in front of what is blurred, nothing of what it
// hides is spread beyond it, and what a pixel shows of the classes adds up to one.

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

// The passes over images with so many classes.
struct CellPasses {
    explicit CellPasses(const LensCells& cells, const std::filesystem::path& shaderFolder);

    ShaderDefines defines;
    Program spread, average, averageNearest, blur;
};

class CellSums {
public:
    // Of the pixels of `blockSums`, between which the block's sum changes from wave to wave; `cells` has classes, and
    // `passes`, which must outlive it, are for as many.
    CellSums(const LensCells& cells, const GlTexture (&blockSums)[2], const CellPasses& passes);

    // What shaders/accumulation/add_layers.frag needs to fill the sums.
    [[nodiscard]] const ShaderDefines& defines() const { return passes_->defines; }
    // `to`: the block's sum that is written beside them.
    void bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur, bool startsBlock,
                       int to) const;
    // Writes the block's sum with blurred cells, and zeros for what it lost, to `target`. `sum` holds the block as it
    // was added. With `samples` > 0 it is the mean of so many, with 0 of as many as a pixel's alpha counts.
    void blurInto(const Target& target, const GlTexture& sum, float samples = -1);
    [[nodiscard]] bool fits(const LensCells& cells) const {
        return cells.inFront == inFront_ && cells.behind == behind_;
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    int inFront_;
    int behind_;
    const CellPasses* passes_;
    GlTexture sums_;           // a layer a class, as shaders/include/cells.glsl orders them
    Target addingTargets_[2];  // each of the block's sums, with the first of the classes
    GlTexture held_;           // which classes a tile holds
    GlTexture spread_;         // of which it needs means
    Target spreadTarget_;
    // Around the middles of squares of pixels, of what lies in front of the focus and behind it a layer each, one class
    // beside the other: what it shows, and the samples that are open to it.
    glm::ivec2 squares_;  // of single pixels, columns and rows
    GlTexture shownMeans_, openMeans_;
    Target meanTargets_[2];
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
