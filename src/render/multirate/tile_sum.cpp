#include "render/multirate/tile_sum.h"

#include <fmt/format.h>

#include <bit>
#include <glm/vec2.hpp>
#include <vector>

namespace defocus {

namespace {

constexpr TileLayers ownLayers = 1;

TileLayers largerLayers(std::size_t rate) {
    return static_cast<TileLayers>(2u << rate);
}

}  // namespace

LayerSum& TileSum::larger(std::size_t rate) {
    if (!larger_[rate]) {
        LayerSumInfo info = own_;
        const glm::ivec2 size = layerSize({own_.width, own_.height}, largerPixelRates[rate]);
        info.width = size.x;
        info.height = size.y;
        larger_[rate].emplace(info);
    }
    return *larger_[rate];
}

void TileSum::beginBlock(const Tiles& tiles, const View& view) {
    for (auto& sum : larger_)
        if (sum) sum->reset();
    for (TileLayers layers = 0; layers < tileKinds; ++layers) {
        std::vector<glm::vec2> corners;
        for (const PixelArea& area : tileAreas(tiles, layers, view))
            for (const glm::ivec2& corner : {glm::ivec2(area.left, area.bottom), glm::ivec2(area.right, area.bottom),
                                             glm::ivec2(area.right, area.top), glm::ivec2(area.left, area.bottom),
                                             glm::ivec2(area.right, area.top), glm::ivec2(area.left, area.top)})
                corners.emplace_back(2.0 * corner.x / view.width - 1, 2.0 * corner.y / view.height - 1);
        TileSet& set = sets_[layers];
        set.vertexCount = static_cast<int>(corners.size());
        set.corners = Buffer::of(std::span<const glm::vec2>(corners));
        set.array.attribute(0, 2, GL_FLOAT, false);
        set.array.bind(0, set.corners, 0, sizeof(glm::vec2));
    }
}

// The rate of the larger pixels that alone show something.
std::optional<std::size_t> TileSum::onlyLarger(TileLayers layers) const {
    for (std::size_t rate = 0; rate < larger_.size(); ++rate)
        if (layers == largerLayers(rate)) return rate;
    return {};
}

Program TileSum::programFor(TileLayers layers) const {
    ShaderDefines defines = defines_;
    for (const auto& define : layerFormatDefines(own_.format)) defines.push_back(define);
    const char* fragment = "accumulation/add_layers.frag";
    if (layers == 0) defines.emplace_back("EMPTY_LAYERS", "1");
    if (const auto rate = onlyLarger(layers)) {
        fragment = "multirate/interpolate.frag";
        defines.emplace_back("PIXEL_RATE", std::to_string(largerPixelRates[*rate]));
    } else if (std::popcount(layers) > 1) {
        defines.emplace_back("MIXED_LAYERS", "1");
        if (layers & ownLayers) defines.emplace_back("OWN_LAYERS", "1");
        for (std::size_t rate = 0; rate < larger_.size(); ++rate)
            if (layers & largerLayers(rate))
                defines.emplace_back(fmt::format("LARGE_RATE_{}", rate), std::to_string(largerPixelRates[rate]));
    }
    return Program({{"multirate/tiles.vert", fragment}, defines, own_.shaderFolder});
}

void TileSum::endWave(LayerSum& own, const FrameUniforms& frame, std::uint32_t first, std::uint32_t count) {
    if (defines_ != frame.defines()) {
        defines_ = frame.defines();
        for (TileSet& set : sets_) set.program = {};
    }
    own.addWave(count, frame.countsInAlpha(), [&](std::uint32_t firstInBlock) {
        frame.bind(first);
        for (TileLayers layers = 0; layers < tileKinds; ++layers) {
            TileSet& set = sets_[layers];
            if (set.vertexCount == 0 || onlyLarger(layers)) continue;
            if (!set.program) set.program = programFor(layers);
            own.layerColors().attach(0);
            own.layerDepths().attach(3);
            for (std::size_t rate = 0; rate < larger_.size(); ++rate) {
                if (!(layers & largerLayers(rate))) continue;
                larger_[rate]->layerColors().attach(rate == 0 ? 4 : 7);
                larger_[rate]->layerDepths().attach(rate == 0 ? 6 : 8);
            }
            glProgramUniform1i(set.program.name(), 0, static_cast<GLint>(count));
            glProgramUniform1i(set.program.name(), 1, static_cast<GLint>(firstInBlock));
            draw(layers);
        }
        for (std::size_t rate = 0; rate < larger_.size(); ++rate) {
            TileSet& set = sets_[largerLayers(rate)];
            if (set.vertexCount == 0) continue;
            if (!set.program) set.program = programFor(largerLayers(rate));
            larger_[rate]->blockSum().attach(0);
            larger_[rate]->blockCompensation().attach(1);
            draw(largerLayers(rate));
        }
    });
}

void TileSum::draw(TileLayers layers) {
    const TileSet& set = sets_[layers];
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    set.program.use();
    glBindVertexArray(set.array.name());
    glDrawArrays(GL_TRIANGLES, 0, set.vertexCount);
}

std::size_t TileSum::bytes() const {
    std::size_t total = 0;
    for (const auto& sum : larger_) total += sum ? sum->bytes() : 0;
    for (const TileSet& set : sets_) total += set.corners.bytes();
    return total;
}

}  // namespace defocus
