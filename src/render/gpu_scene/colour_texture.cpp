#include "render/gpu_scene/colour_texture.h"

#include <epoxy/gl.h>

#include <vector>

namespace defocus::engine {

GlTexture colourMapTexture(glm::vec3 (*map)(float)) {
    constexpr int width = 256;
    std::vector<float> rgba;
    for (int i = 0; i < width; ++i) {
        const glm::vec3 colour = map(static_cast<float>(i) / (width - 1));
        rgba.insert(rgba.end(), {colour.r, colour.g, colour.b, 1.0f});
    }
    GlTexture texture({.format = TextureFormat::rgba16f, .width = width, .height = 1, .linear = true});
    texture.upload(0, width, 1, rgba.data());
    return texture;
}

}  // namespace defocus::engine
