#include "gl/read_back.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace defocus::engine {

namespace {

void turnRows(Image& image) {
    const std::size_t rowFloats = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    for (int y = 0; y < image.height / 2; ++y)
        std::swap_ranges(image.at(0, y), image.at(0, y) + rowFloats, image.at(0, image.height - 1 - y));
}

}  // namespace

Image readBack(const GlTexture& texture, int channels) {
    Image image(texture.info().width, texture.info().height, channels);
    const bool depths = texture.info().format == TextureFormat::depth32f;
    const GLenum format = depths ? GL_DEPTH_COMPONENT : channels == 1 ? GL_RED : channels == 3 ? GL_RGB : GL_RGBA;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(texture.name(), 0, 0, 0, 0, image.width, image.height, 1, format, GL_FLOAT,
                         static_cast<GLsizei>(image.pixels.size() * sizeof(float)), image.pixels.data());
    turnRows(image);
    return image;
}

HalfImage readHalves(const GlTexture& texture) {
    const auto [width, height] = std::pair(texture.info().width, texture.info().height);
    HalfImage image{width, height, std::vector<std::uint16_t>(4 * std::size_t(width) * std::size_t(height))};
    glGetTextureSubImage(texture.name(), 0, 0, 0, 0, width, height, 1, GL_RGBA, GL_HALF_FLOAT,
                         static_cast<GLsizei>(image.rgba.size() * sizeof(std::uint16_t)), image.rgba.data());
    return image;
}

void upload(GlTexture& texture, const Image& image) {
    Image rows = image;
    turnRows(rows);
    texture.upload(0, rows.width, rows.height, rows.pixels.data());
}

}  // namespace defocus::engine
