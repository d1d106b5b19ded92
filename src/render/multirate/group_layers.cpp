#include "render/multirate/group_layers.h"

#include <algorithm>

namespace defocus::engine {

namespace {

GlTexture groupTexture(const LayerSum& sum, TextureFormat format, std::uint32_t layers) {
    return GlTexture(
        {.format = format, .width = sum.info().width, .height = sum.info().height, .layers = static_cast<int>(layers)});
}

// Groups have two samples or more, and a wave may begin and end within one.
std::uint32_t groupsOfWave(std::uint32_t samples) {
    return std::min(samples / 2 + 1, rateBlock / 2);
}

}  // namespace

GroupLayers::GroupLayers(const LayerSum& sum)
    : count_(groupsOfWave(sum.info().layers)),
      colors_(groupTexture(sum, layerTextureFormat(sum.info().format), count_)),
      depths_(groupTexture(sum, TextureFormat::depth32f, count_)),
      target_({&colors_}, &depths_) {}

void GroupLayers::begin(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t group = first; group < end; ++group) {
        colors_.clearLayer(group % count_);
        depths_.clearLayer(group % count_);
    }
    target_.bind();
}

void GroupLayers::copyTo(const LayerSum& sum, std::uint32_t layer, std::uint32_t group,
                         const std::vector<PixelArea>& areas) const {
    for (const PixelArea& area : areas) {
        const TexelRectangle texels{area.left, area.bottom, area.right - area.left, area.top - area.bottom};
        colors_.copyLayer(group % count_, texels, sum.layerColors(), layer);
        depths_.copyLayer(group % count_, texels, sum.layerDepths(), layer);
    }
}

}  // namespace defocus::engine
