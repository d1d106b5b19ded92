#include "render/lens_images/image_stack.h"

#include <epoxy/gl.h>

#include <array>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

namespace defocus::engine {

ImageStack::ImageStack(std::filesystem::path shaderFolder)
    : store_({{fullscreenShader, "view/kept_image.frag"}, {}, shaderFolder}),
      sum_({{fullscreenShader, "view/refocus.frag"}, {}, std::move(shaderFolder)}) {}

void ImageStack::allocate(int width, int height, std::uint32_t count) {
    assert(count >= 1 && count <= maxImages);
    images_ = GlTexture(
        {.format = TextureFormat::rgba16f, .width = width, .height = height, .layers = static_cast<int>(count)});
}

void ImageStack::store(std::uint32_t image, const GlTexture& texture) {
    const Target layer = Target::ofLayer({&images_}, image);
    layer.bind();
    texture.attach(0);
    fullscreen_.draw(store_);
}

void ImageStack::drawMean(std::span<const Part> parts, int width, int height) {
    assert(!parts.empty() && parts.size() <= maxImages);
    std::array<glm::ivec3, maxImages> corners;
    for (std::size_t i = 0; i < parts.size(); ++i)
        corners[i] = glm::ivec3(parts[i].corner, static_cast<int>(parts[i].image));
    if (!mean_ || mean_.info().width != width || mean_.info().height != height) {
        mean_ = GlTexture({.format = TextureFormat::rgba32f, .width = width, .height = height});
        mean_.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
        meanTarget_ = Target({&mean_});
    }
    meanTarget_.bind();
    images_.attach(0);
    glProgramUniform1i(sum_.name(), 0, static_cast<GLint>(parts.size()));
    glProgramUniform3iv(sum_.name(), 1, static_cast<GLsizei>(parts.size()), glm::value_ptr(corners.front()));
    fullscreen_.draw(sum_);
}

}  // namespace defocus::engine
