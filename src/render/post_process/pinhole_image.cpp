#include "render/post_process/pinhole_image.h"

namespace defocus::engine {

PinholeImage::PinholeImage(int width, int height, LayerFormat format, TextureFormat depthFormat, bool keepsOwnBlur,
                           int samples) {
    const auto textureOf = [&](TextureFormat of, bool linear = false) {
        return GlTexture({.format = of, .width = width, .height = height, .samples = samples, .linear = linear});
    };
    color = textureOf(layerTextureFormat(format), true);
    depth = textureOf(depthFormat);
    if (keepsOwnBlur) ownBlur = textureOf(TextureFormat::rg32f);
}

void PinholeImage::attachForBlur() const {
    depth.attach(1);
    if (ownBlur) ownBlur.attach(6);
}

void PinholeImage::readAsCoverage(bool on) {
    constexpr GLint radiance[4] = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
    constexpr GLint coverage[4] = {GL_ALPHA, GL_ALPHA, GL_ALPHA, GL_ALPHA};
    for (const PinholeImage* image : {static_cast<const PinholeImage*>(this), multisampled})
        if (image != nullptr)
            glTextureParameteriv(image->color.name(), GL_TEXTURE_SWIZZLE_RGBA, on ? coverage : radiance);
}

}  // namespace defocus::engine
