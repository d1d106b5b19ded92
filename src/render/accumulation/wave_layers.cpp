#include "render/accumulation/wave_layers.h"

namespace defocus::engine {

namespace {

GlTexture layersOf(const WaveLayersInfo& info, TextureFormat format) {
    return GlTexture(
        {.format = format, .width = info.width, .height = info.height, .layers = static_cast<int>(info.count)});
}

}  // namespace

WaveLayers::WaveLayers(const WaveLayersInfo& info)
    : info_(info),
      colors_(layersOf(info, layerTextureFormat(info.format))),
      depths_(layersOf(info, TextureFormat::depth32f)),
      target_({&colors_}, &depths_) {}

void WaveLayers::begin(const std::optional<LayerWindow>& window) const {
    target_.bind();
    if (window) glViewport(-window->imageLeft, -window->imageBottom, window->imageWidth, window->imageHeight);
    if (window && window->cut) {
        glScissor(window->left, window->bottom, window->width, window->height);
        glEnable(GL_SCISSOR_TEST);
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    constexpr float farthest = 0;  // depth is reversed
    constexpr float transparent[4] = {};
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, transparent);
}

void WaveLayers::end() {
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace defocus::engine
