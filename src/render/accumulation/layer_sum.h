#pragma once
// Sums the layers of all samples of a frame (a layer is the image of one lens sample), with compensation of rounding
// errors.
//
// Layers are added in sample order, with Neumaier's compensation, to the sum of a block of 64 samples. Complete blocks
// are added to the frame's sum in the same way. The result is bit-identical for any number K of samples that are drawn
// together, and also if several machines render the blocks. The mean is written to a separate texture; the sum itself
// is never divided.

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <utility>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "image/image.h"
#include "render/accumulation/cell_sums.h"
#include "render/accumulation/wave_layers.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layer_format.h"
#include "render/renderer.h"

namespace defocus::engine {

struct LayerSumInfo {
    int width = 1;  // width of the accumulation buffers, in pixels of the image
    int height = 1;
    LayerFormat format = LayerFormat::rgba16f;  // format of the layers; not LayerFormat::automatic
    std::filesystem::path shaderFolder = {};
    bool operator==(const LayerSumInfo&) const = default;
};

class LayerSum {
public:
    explicit LayerSum(const LayerSumInfo& info);

    // Clears the accumulation buffers. `first`: pixel of the layers that is added to the lower left pixel of the
    // buffers.
    void reset(const glm::ivec2& first = {0, 0});
    // From the next block on, blurs each sample's image by the blur of its lens cell, the part of the lens that the
    // sample represents. All samples so far must form complete blocks of 64. If `cells` has no blur classes (groups of
    // pixel values with similar blur), nothing is blurred. reset() turns the blur off.
    void blurCells(const LensCells& cells);
    // Composites layers [0, count) over the environment and adds them to the sum. The layers contain samples [first,
    // first + count) of `frame`, which must be in one block of 64 samples.
    void add(const WaveLayers& layers, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }
    // Returns the sum of the latest block of 64 samples, which may be incomplete. Needs at least one sample.
    [[nodiscard]] BlockSum block();
    // Adds a block that was summed on another machine; the result is bit-identical to drawing the block here. All
    // samples so far must form complete blocks. `block` is RGBA, has the size of the accumulation buffers and contains
    // 64 samples, or fewer if it is the frame's last block.
    void addBlock(const BlockSum& block);
    // Computes the mean of all samples so far, unless it is already up to date. Needs at least one sample.
    void makeMean();
    // Returns the mean of all samples so far as RGBA. Needs at least one sample.
    [[nodiscard]] Image mean();
    // Returns the mean of all samples so far as a texture with row 0 at the bottom. The texture is valid until further
    // samples are added.
    [[nodiscard]] const GlTexture& meanTexture();
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] const LayerSumInfo& info() const { return info_; }

private:
    // A compensated sum in two copies: passes read one copy and write the other.
    struct Sum {
        explicit Sum(int width, int height);
        void flip() { current = 1 - current; }
        GlTexture sum[2];
        GlTexture compensation[2];
        Target target[2];
        int current = 0;  // index of the copy that holds the latest sum
    };
    // Returns the index of the copy of block_ that holds the sum of the current block of samples. `asAdded`: returns
    // the sum in the form in which it is added to the frame's sum. With lens cells (parts of the lens, one per sample),
    // this form is blurred; it is written to the second copy.
    int latestBlock(bool asAdded);
    void addBlockTo(Sum& frame, int block, bool startsFrame);
    // Divides a sum by `divisor`, or by the pixel's alpha (its number of samples) if `divisor` is 0. Writes the result
    // to mean_. `latest`: index of the copy of `total` that holds the sum.
    void divide(const Sum& total, int latest, float divisor);

    LayerSumInfo info_;
    glm::ivec2 first_{0, 0};
    Sum block_;
    Sum frame_;
    GlTexture mean_;  // allocated on first use
    bool meanIsCurrent_ = false;
    Target meanTarget_;
    // Programs that add layers to the sum, keyed by their defines, which may change from frame to frame.
    std::map<ShaderDefines, Program> addLayers_;
    // Programs that blur the sum of a block by the blur of its samples' lens cells (parts of the lens), keyed by the
    // numbers of blur classes (groups of pixel values with similar blur) in front of and behind the focus plane.
    std::map<std::pair<int, int>, CellPasses> cellPasses_;
    // Sums of the blur classes of the latest block that used lens cells. Kept because the next frame can reuse the
    // textures if it has the same number of blur classes, as is often the case.
    std::optional<CellSums> cells_;
    bool blursCells_ = false;
    double cellBlur_ = 0;
    Program addBlock_;
    Program resolve_;
    Fullscreen fullscreen_;
    std::uint32_t samples_ = 0;
    bool countsInAlpha_ = false;
};

}  // namespace defocus::engine
