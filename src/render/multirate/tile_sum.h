#pragma once
// Adds a wave's layers, of the image's own pixels and of larger ones, to the sum of its block, each tile of the image
// in the cheapest way (plan/tiles.h): layers of one kind are summed as they are, and only where several kinds show
// something is each sample composed of them.

#include <array>
#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "plan/tiles.h"
#include "render/accumulation/layer_sum.h"

namespace defocus {

class TileSum {
public:
    // `own`: the sum of the layers with the image's own pixels, of which there are as many as of each other kind.
    explicit TileSum(const LayerSum& own) : own_(own.info()) {}

    // A block begins whose tiles these are.
    void beginBlock(const Tiles& tiles, const View& view);
    // The layers with pixels of largerPixelRates[rate], as a sum of their own, which begins with the block.
    [[nodiscard]] LayerSum& larger(std::size_t rate);
    // Adds the wave's layers to `own`: its own, for samples [first, first + count) of the block, and those of larger
    // pixels, which are summed already.
    void endWave(LayerSum& own, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count);
    [[nodiscard]] std::size_t bytes() const;

private:
    struct TileSet {  // the tiles that show the same kinds of layers
        VertexArray array;
        Buffer corners;
        int vertexCount = 0;
        Program program;  // made when first needed
    };
    void draw(TileLayers layers);
    [[nodiscard]] Program programFor(TileLayers layers) const;
    [[nodiscard]] std::optional<std::size_t> onlyLarger(TileLayers layers) const;

    LayerSumInfo own_;
    std::array<std::optional<LayerSum>, largerPixelRates.size()> larger_;  // made when first asked for
    std::array<TileSet, tileKinds> sets_;
    ShaderDefines defines_;  // that the programs were built with
};

}  // namespace defocus
