#include "render/lens_images/image_stack.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

#include "core/parallel.h"
#include "gl/read_back.h"

namespace defocus::engine {

namespace {

constexpr int stripRows = 4;  // rows that a thread sums at a time, so that the sums stay in its cache

}  // namespace

ImageStack::ImageStack(std::filesystem::path shaderFolder, bool software)
    : software_(software),
      store_({{fullscreenShader, "view/kept_image.frag"}, {}, shaderFolder}),
      sum_({{fullscreenShader, "view/refocus.frag"}, {}, std::move(shaderFolder)}) {}

void ImageStack::allocate(int width, int height, std::uint32_t count) {
    assert(count >= 1 && count <= maxImages);
    const int layers = software_ ? 1 : static_cast<int>(count);
    images_ = GlTexture({.format = TextureFormat::rgba16f, .width = width, .height = height, .layers = layers});
    if (software_) halves_.resize(count);
}

void ImageStack::free() {
    images_ = {};
    halves_.clear();
}

std::size_t ImageStack::bytes() const {
    return software_ ? images_.bytes() * halves_.size() : images_.bytes();
}

void ImageStack::store(std::uint32_t image, const GlTexture& texture) {
    const Target layer = Target::ofLayer({&images_}, software_ ? 0 : image);
    layer.bind();
    texture.attach(0);
    fullscreen_.draw(store_);
    if (software_) halves_[image] = readHalves(images_);
}

void ImageStack::computeMean(std::span<const Part> parts, int width, int height) {
    assert(!parts.empty() && parts.size() <= maxImages);
    if (!mean_ || mean_.info().width != width || mean_.info().height != height) {
        mean_ = GlTexture({.format = TextureFormat::rgba32f, .width = width, .height = height, .linear = true});
        meanTarget_ = Target({&mean_});
    }
    if (software_)
        sumMean(parts);
    else
        drawMean(parts);
}

void ImageStack::drawMean(std::span<const Part> parts) {
    std::array<glm::ivec3, maxImages> corners;
    for (std::size_t i = 0; i < parts.size(); ++i)
        corners[i] = glm::ivec3(parts[i].corner, static_cast<int>(parts[i].image));
    meanTarget_.bind();
    images_.attach(0);
    glProgramUniform1i(sum_.name(), 0, static_cast<GLint>(parts.size()));
    glProgramUniform3iv(sum_.name(), 1, static_cast<GLsizei>(parts.size()), glm::value_ptr(corners.front()));
    fullscreen_.draw(sum_);
}

void ImageStack::sumMean(std::span<const Part> parts) {
    const int height = mean_.info().height;
    const std::size_t rowFloats = 4 * static_cast<std::size_t>(mean_.info().width);
    const float weight = 1.0f / static_cast<float>(parts.size());
    sums_.resize(rowFloats * static_cast<std::size_t>(height));
    parallelFor(static_cast<std::size_t>((height + stripRows - 1) / stripRows), [&](std::size_t strip) {
        const int first = static_cast<int>(strip) * stripRows;
        const int end = std::min(first + stripRows, height);
        float* const begin = sums_.data() + rowFloats * static_cast<std::size_t>(first);
        const std::span sums(begin, rowFloats * static_cast<std::size_t>(end - first));
        std::ranges::fill(sums, 0.0f);
        for (const Part& part : parts)
            for (int y = first; y < end; ++y)
                addHalves(halves_[part.image].at(part.corner.x, part.corner.y + y), rowFloats,
                          begin + rowFloats * static_cast<std::size_t>(y - first));
        for (float& sum : sums) sum *= weight;
    });
    mean_.upload(0, mean_.info().width, height, sums_.data());
}

}  // namespace defocus::engine
