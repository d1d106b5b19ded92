#pragma once
// Helpers that add textures with distinct texels to the lit wall, and return the texel that a pixel of the wall shows.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>

#include "render/lit_wall.h"

namespace defocus::engine {

// Returns the linear value of an 8-bit sRGB value (IEC 61966-2-1).
inline double linearOf(int code) {
    const double encoded = code / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

using Texel = std::array<int, 4>;

// Adds an image of `size`² texels to the scene, and a texture with nearest filtering. Returns the texture's index.
inline int addTexture(Scene& scene, int size, const std::function<Texel(int column, int row)>& texel) {
    TextureImage image;
    image.width = image.height = size;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            for (const int channel : texel(column, row)) image.rgba.push_back(static_cast<std::uint8_t>(channel));
    scene.images.push_back(std::move(image));
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    texture.magnification = texture.minification = Filter::nearest;
    texture.mipmaps = false;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

// Returns a texel of a 4 × 4 texture. All channels of all texels have different values.
inline Texel scrambled(int column, int row) {
    const int i = 4 * row + column;
    return {(i * 37 + 11) % 256, (i * 61 + 50) % 256, (i * 89 + 5) % 256, (i * 23 + 90) % 256};
}

// Returns the texel of a `size`² image at the texture coordinates `uv`, or nullopt near a texel's border, where
// rounding decides.
inline std::optional<glm::ivec2> texelAt(const glm::dvec2& uv, int size) {
    const glm::dvec2 place = uv * double(size);
    const glm::dvec2 away = glm::abs(place - glm::round(place));
    if (std::min(away.x, away.y) < 0.01) return {};
    return glm::ivec2(glm::floor(place));
}

// Returns the tolerance for the linear value of an 8-bit sRGB value. It is half the step to the next value, since
// drivers approximate sRGB decoding with polynomials.
inline double decodingError(int code) {
    return 0.5 * (linearOf(std::max(code, 1)) - linearOf(std::max(code, 1) - 1));
}
inline glm::dvec3 decoded(const Texel& texel) {
    return {linearOf(texel[0]), linearOf(texel[1]), linearOf(texel[2])};
}
inline glm::dvec3 decodingErrors(const Texel& texel) {
    return {decodingError(texel[0]), decodingError(texel[1]), decodingError(texel[2])};
}

// Calls `check` for each pixel with its texel of a 4 × 4 texture. `placed` maps texture coordinates of the wall to
// coordinates in [0, 1] inside the texture.
inline void forTexels(const SmallWorld& small, const std::function<glm::dvec2(const glm::dvec2&)>& placed,
                      const std::function<void(const Image&, const WallPoint&, const Texel&)>& check) {
    const Image image = wallImage(small);
    int compared = 0;
    for (const WallPoint& point : wallPoints(small)) {
        const std::optional<glm::ivec2> at = texelAt(placed(point.uv), 4);
        if (!at) continue;
        ++compared;
        check(image, point, scrambled(std::min(at->x, 3), std::min(at->y, 3)));
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(compared, 500);
}

inline glm::dvec2 asTheyAre(const glm::dvec2& uv) {
    return uv;
}

}  // namespace defocus::engine
