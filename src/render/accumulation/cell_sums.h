#pragma once
// Sums the pixel values of a block of 64 lens samples separately by blur class, and returns the block's image with each
// class blurred. A blur class is a group of pixel values that need a similar blur. This is not the blur of the entire
// lens, but that of the sample's lens cell, the part of the lens that the sample represents
// (plan/lens_cells/lens_cells.h).
//
// The classes are composited from the farthest to the nearest: behind the focus plane from more to less blur, then
// unblurred pixel values, then in front of the focus plane from less to more blur. Each class is averaged only over the
// samples in which no nearer class covers the pixel. Thus a sharp outline remains sharp in front of a blurred
// background, and hidden background does not leak out. The weights of all classes in a pixel sum to 1.

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

// Shader programs for a given number of blur classes in front of and behind the focus plane.
struct CellPasses {
    explicit CellPasses(const LensCells& cells, const std::filesystem::path& shaderFolder);

    ShaderDefines defines;
    Program spread, average, averageNearest, blur;
};

class CellSums {
public:
    // `blockSums`: two textures for the sum of the current block of samples; each batch (wave) of samples reads the sum
    // from one texture and writes the new sum to the other. `cells` must have at least one blur class (group of pixel
    // values with similar blur). `passes` must have been built for the same number of classes and must outlive this
    // object.
    CellSums(const LensCells& cells, const GlTexture (&blockSums)[2], const CellPasses& passes);

    // Returns the defines of shaders/accumulation/add_layers_to_cells.frag, which adds layers (images of samples) to
    // the sums, one per blur class (group of pixel values with similar blur).
    [[nodiscard]] const ShaderDefines& defines() const { return passes_->defines; }
    // Binds the targets and textures for program `addLayers`. The program adds a batch of samples to the sums of the
    // blur classes, which group pixel values by blur, and to the sum of the current block of samples. `to`: index in
    // `blockSums` of the texture that receives the block's sum.
    void bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur, bool startsBlock,
                       int to) const;
    // Blurs the sum of the current block of samples, each blur class by its own amount, and writes the result to
    // `target`. Sets the target's second attachment, which holds rounding errors, to 0. `sum` is the block's sum
    // without blur. The result is divided by `samples` if `samples` > 0, by the pixel's alpha (its number of samples)
    // if 0, and by nothing if negative.
    void blurInto(const Target& target, const GlTexture& sum, float samples = -1);
    [[nodiscard]] bool fits(const LensCells& cells) const {
        return cells.inFront == inFront_ && cells.behind == behind_;
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    int inFront_;
    int behind_;
    const CellPasses* passes_;
    GlTexture sums_;  // sums of the blur classes, one layer per class; see shaders/include/cells.glsl
    // Framebuffers for adding a batch of samples. Attachment 0 is one of the two textures with the sum of the current
    // block of samples; the other attachments are layers of sums_.
    Target addingTargets_[2];
    GlTexture held_;  // per tile of 8 x 8 px: bit mask of the blur classes in the tile
    // Two bit masks per tile, with one bit per blur class (group of pixel values with similar blur): the classes whose
    // means over squares of pixels are read in the tile, and the classes whose means must be written there.
    GlTexture spread_;
    Target spreadTarget_;
    // Means over squares of pixels, for each blur class (group of pixel values with similar blur). shownMeans_:
    // radiance and number of the class's samples; openMeans_: number of samples in which no nearer class covers the
    // pixel. Layer 0 holds the classes in front of the focus plane, and layer 1 the classes behind it. The classes of a
    // layer are side by side.
    glm::ivec2 squares_;  // columns and rows of the finest grid, whose squares have the size of a pixel
    GlTexture shownMeans_, openMeans_;
    Target meanTargets_[2];
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
