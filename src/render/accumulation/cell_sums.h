#pragma once
// Sums the pixels of a block by the blur class of their lens cells (plan/lens_cells.h) and produces the block's image
// with each class blurred.
//
// The classes are composited from the farthest to the nearest. Behind the focus plane more blur means farther away; in
// front of it more blur means nearer; sharp pixels lie between. Each class is blurred only among the samples that show
// no nearer class. A sharp outline thus stays sharp in front of a blurred background, and hidden background does not
// leak out. The weights of all classes in a pixel add up to one.

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

// Shader programs for a given number of classes.
struct CellPasses {
    explicit CellPasses(const LensCells& cells, const std::filesystem::path& shaderFolder);

    ShaderDefines defines;
    Program spread, average, averageNearest, blur;
};

class CellSums {
public:
    // `blockSums`: the two textures that the block's sum alternates between from wave to wave. `cells` must have at
    // least one class. `passes` must have been built for the same classes and must outlive this object.
    CellSums(const LensCells& cells, const GlTexture (&blockSums)[2], const CellPasses& passes);

    // Returns the defines with which shaders/accumulation/add_layers_to_cells.frag fills the class sums.
    [[nodiscard]] const ShaderDefines& defines() const { return passes_->defines; }
    // Binds the targets and textures for adding layers. `to`: index of the block sum that is written together with the
    // class sums.
    void bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur, bool startsBlock,
                       int to) const;
    // Writes the block's sum with blurred cells to `target`, with zero compensation. `sum` holds the block without
    // blur. `samples` > 0 divides by that number, 0 divides by the pixel's alpha; the default writes the sum.
    void blurInto(const Target& target, const GlTexture& sum, float samples = -1);
    [[nodiscard]] bool fits(const LensCells& cells) const {
        return cells.inFront == inFront_ && cells.behind == behind_;
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    int inFront_;
    int behind_;
    const CellPasses* passes_;
    GlTexture sums_;           // one layer per class, in the order of shaders/include/cells.glsl
    Target addingTargets_[2];  // each has one of the block's sums and the first classes
    GlTexture held_;           // bit mask of the classes present in each tile
    GlTexture spread_;         // bit mask of the classes whose means each tile needs
    Target spreadTarget_;
    // Means over squares of pixels: the radiance shown, and the number of samples that no nearer class covers. Layer 0
    // is in front of the focus plane, layer 1 behind it. The classes lie side by side in a layer.
    glm::ivec2 squares_;  // columns and rows of the finest grid, whose squares are single pixels
    GlTexture shownMeans_, openMeans_;
    Target meanTargets_[2];
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
