#pragma once
// The accumulation target: K layers, one a lens sample, and the compensated sums they are added to.
//
// Layers are added one after the other, in order, with Neumaier's compensation, to the sum of a block of 64 samples,
// and finished blocks likewise to the frame's sum: the same pixels for every K, and for every split over machines at
// block borders. The sum is divided when it is read, never in place.

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
#include "render/sampling/layer_window.h"

namespace defocus::engine {

struct LayerSumInfo {
    int width = 1;  // px, of the layers and the sums
    int height = 1;
    std::uint32_t layers = 1;                   // K, 1 … 64
    LayerFormat format = LayerFormat::rgba16f;  // not automatic
    std::filesystem::path shaderFolder;
    // px, of sums that hold a part of the layers alone (see reset); 0: they are as large as the layers.
    int sumWidth = 0;
    int sumHeight = 0;
};

class LayerSum {
public:
    explicit LayerSum(const LayerSumInfo& info);

    // Forgets everything summed. `window`: which pixels of the layers are drawn and summed from now on, as many as the
    // sums have; none: all of them.
    void reset(const std::optional<LayerWindow>& window = {});
    // Blurs the lens cells of all further blocks; those before must be whole. After reset() there are none.
    void blurCells(const LensCells& cells);
    // Clears the layers to nothing (black, transparent, infinitely far) and makes them the render target.
    void beginWave();
    // The layers as a target, which beginWave makes current.
    [[nodiscard]] const Target& layers() const { return layerTarget_; }
    // What it draws into.
    [[nodiscard]] const GlTexture& layerColors() const { return layers_; }
    [[nodiscard]] const GlTexture& layerDepths() const { return depth_; }
    // Adds layers [0, count), each composed over the environment of `frame`, for whose samples from `first` on they
    // were drawn; `count` ≤ K and not beyond the block's end.
    void endWave(const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] std::uint32_t samples() const { return samples_; }
    // The block that the last wave belongs to, as far as it is summed. At least one sample.
    [[nodiscard]] BlockSum block();
    // Goes on with a block that was summed elsewhere, as if its waves had been drawn here: the same bits. The samples
    // so far must be whole blocks; `block` holds RGBA of this size and 1 … 64 samples. Only the frame's last block may
    // have less than 64.
    void addBlock(const BlockSum& block);
    // Makes the mean of the samples so far, at least one, unless it is made.
    void makeMean();
    // The mean of the samples so far, RGBA. At least one.
    [[nodiscard]] Image mean();
    // The same on the GPU, row 0 at the bottom, until more is summed.
    [[nodiscard]] const GlTexture& meanTexture();
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] const LayerSumInfo& info() const { return info_; }

private:
    // A compensated sum of which passes read one copy and write the other.
    struct Sum {
        explicit Sum(int width, int height);
        void flip() { current = 1 - current; }
        GlTexture sum[2];
        GlTexture compensation[2];
        Target target[2];
        int current = 0;  // holds the latest values
    };
    // Which copy of block_ holds the block's sum, once its cells are blurred if it holds them as they were added.
    int latestBlock(bool asAdded);
    void addBlockTo(Sum& frame, int block, bool startsFrame);
    // Writes the mean of what one of the two holds.
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
    GlTexture mean_;  // made when first asked for
    bool meanIsCurrent_ = false;
    Target meanTarget_;
    // By their features: while things move, these come and go.
    std::map<ShaderDefines, Program> addLayers_;
    std::map<std::pair<int, int>, CellPasses> cellPasses_;  // by the classes in front and behind
    std::optional<CellSums> cells_;  // of the last block that had cells: a frame like the one before needs no others
    bool blursCells_ = false;
    double cellBlur_ = 0;
    Program addBlock_;
    Program resolve_;
    Fullscreen fullscreen_;
    std::uint32_t samples_ = 0;
    bool countsInAlpha_ = false;
};

}  // namespace defocus::engine
