#pragma once
// The accumulation target: K layers, one per lens sample, and compensated sums of them.
//
// Layers are added in sample order, with Neumaier's compensation, to the sum of a block of 64 samples. Finished blocks
// are added to the frame's sum in the same way. The result is bit-identical for every K, and for every split over
// machines at block borders. Reading divides a copy; the sum itself stays undivided.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "image/image.h"
#include "render/accumulation/cell_sums.h"
#include "render/gpu_scene/frame_uniforms.h"
#include "render/layer_format.h"
#include "render/renderer.h"
#include "render/gpu_scene/layer_window.h"

namespace defocus::engine {

struct LayerSumInfo {
    int width = 1;  // size of the layers, and of the sums by default, px
    int height = 1;
    std::uint32_t layers = 1;                   // K, 1 … 64
    LayerFormat format = LayerFormat::rgba16f;  // automatic is not allowed
    std::filesystem::path shaderFolder;
    // Size of sums that hold only a part of the layers, px (see reset). 0: the sums are as large as the layers.
    int sumWidth = 0;
    int sumHeight = 0;
};

class LayerSum {
public:
    explicit LayerSum(const LayerSumInfo& info);

    // Clears all sums. `window`: the pixels of the layers to draw and sum; its size must equal that of the sums.
    // Default: all pixels.
    void reset(const std::optional<LayerWindow>& window = {});
    // Blurs the lens cells of all further blocks. Call it at a block border. reset() turns the blur off.
    void blurCells(const LensCells& cells);
    // Clears the layers (black, transparent, infinite depth) and binds them as the render target.
    void beginWave();
    // The layers as a target, which beginWave binds.
    [[nodiscard]] const Target& layers() const { return layerTarget_; }
    // Colour and depth textures of layers().
    [[nodiscard]] const GlTexture& layerColors() const { return layers_; }
    [[nodiscard]] const GlTexture& layerDepths() const { return depth_; }
    // Composites layers [0, count) over the environment and adds them to the sum. They show samples `first` … of
    // `frame`. `count` ≤ K, and the wave must end within its block.
    void endWave(const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }
    // Returns the sum of the block that the last wave belongs to, finished or not. Needs at least one sample.
    [[nodiscard]] BlockSum block();
    // Continues the sum with a block that was summed elsewhere; the result is bit-identical to drawing it here. The
    // samples so far must be complete blocks of 64. `block` is RGBA, of the size of the sums, with 1 … 64 samples. Only
    // the frame's last block may have fewer than 64.
    void addBlock(const BlockSum& block);
    // Computes the mean of the samples so far, at least one, unless it is up to date.
    void makeMean();
    // Returns the mean of the samples so far as RGBA. Needs at least one sample.
    [[nodiscard]] Image mean();
    // Returns the same mean as a texture, row 0 at the bottom. Valid until further samples are added.
    [[nodiscard]] const GlTexture& meanTexture();
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] const LayerSumInfo& info() const { return info_; }

private:
    // A compensated sum with two copies: passes read one and write the other.
    struct Sum {
        explicit Sum(int width, int height);
        void flip() { current = 1 - current; }
        GlTexture sum[2];
        GlTexture compensation[2];
        Target target[2];
        int current = 0;  // index of the copy with the latest values
    };
    // Returns the index of the copy of block_ that holds the block's sum. `asAdded`: the current copy still lacks the
    // blur of lens cells, so the blur is applied first.
    int latestBlock(bool asAdded);
    void addBlockTo(Sum& frame, int block, bool startsFrame);
    // Writes to mean_ the copy `latest` of a sum, divided by `divisor` (0: by the pixel's alpha).
    void divide(const Sum& total, int latest, float divisor);

    [[nodiscard]] int sumWidth() const { return info_.sumWidth > 0 ? info_.sumWidth : info_.width; }
    [[nodiscard]] int sumHeight() const { return info_.sumHeight > 0 ? info_.sumHeight : info_.height; }

    LayerSumInfo info_;
    std::optional<LayerWindow> window_;
    GlTexture layers_;
    GlTexture depth_;
    Target layerTarget_;
    Sum block_;
    Sum frame_;
    GlTexture mean_;  // allocated on first use
    bool meanIsCurrent_ = false;
    Target meanTarget_;
    // Keyed by features: these change from frame to frame in scenes with motion.
    std::map<ShaderDefines, Program> addLayers_;
    std::map<std::pair<int, int>, CellPasses> cellPasses_;  // keyed by the number of classes in front and behind
    // Kept from the last block that had cells, since the next frame often has the same classes.
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
