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
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "plan/lens_cells.h"

namespace defocus {

class CellSums {
public:
    // Of an image of `width` x `height` px; `cells` has classes.
    CellSums(const LensCells& cells, int width, int height, const std::filesystem::path& shaderFolder);

    // What shaders/accumulation/add_layers.frag needs to fill the sums.
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }
    void bindForAdding(const Program& addLayers, const GlTexture& layerDepths, double blur) const;
    // Writes the block's sum with blurred cells, and zeros for what it lost, to `target`. `sum` holds the block as it
    // was added.
    void blurInto(const Target& target, const GlTexture& sum);
    [[nodiscard]] bool fits(const LensCells& cells) const {
        return cells.inFront == inFront_ && cells.behind == behind_;
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Of a class, and of the samples open to it, around the middles of squares of pixels.
    struct ClassMeans {
        int side = 1;      // px
        GlTexture images;  // layer 0: the class; layer 1, red: the samples
        Target target;
    };

    int inFront_;
    int behind_;
    ShaderDefines defines_;
    GlTexture sums_;  // a layer a class, as shaders/include/cells.glsl orders them
    std::vector<ClassMeans> means_;
    Program average_, averageNearest_, blur_;
    Fullscreen fullscreen_;
};

}  // namespace defocus
