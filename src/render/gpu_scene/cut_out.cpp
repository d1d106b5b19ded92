#include "render/gpu_scene/cut_out.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace defocus::engine {

namespace {

// Sums over squares of texels: the colours of the visible texels (xyz) and the number of these texels (w).
struct SumLevel {
    int width = 0, height = 0;
    std::vector<glm::vec4> sums;

    [[nodiscard]] glm::vec4& at(int x, int y) {
        return sums[static_cast<std::size_t>(std::min(y, height - 1)) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(std::min(x, width - 1))];
    }
};

SumLevel shownTexels(const TextureImage& image, float cutoff) {
    SumLevel level{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const std::uint8_t* const texel = &image.rgba[i];
        const bool shown = static_cast<float>(texel[3]) >= 255 * cutoff;
        level.sums.push_back(shown ? glm::vec4(texel[0], texel[1], texel[2], 1) : glm::vec4(0));
    }
    return level;
}

// Returns the sums over squares with twice the side length. If the number of columns or rows of `fine` is odd, the last
// column or row counts twice.
SumLevel halved(SumLevel& fine) {
    SumLevel coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
            coarse.sums.push_back(fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) + fine.at(2 * x, 2 * y + 1) +
                                  fine.at(2 * x + 1, 2 * y + 1));
    return coarse;
}

}  // namespace

std::vector<std::uint8_t> cutOut(const TextureImage& image, float cutoff) {
    std::vector<SumLevel> levels = {shownTexels(image, cutoff)};
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
    // From coarse to fine, give each square without visible texels the colour sum and texel count of the next larger
    // square that contains it.
    for (std::size_t i = levels.size() - 1; i-- > 0;)
        for (int y = 0; y < levels[i].height; ++y)
            for (int x = 0; x < levels[i].width; ++x)
                if (levels[i].at(x, y).w == 0) levels[i].at(x, y) = levels[i + 1].at(x / 2, y / 2);
    std::vector<std::uint8_t> rgba;
    rgba.reserve(image.rgba.size());
    for (std::size_t i = 0; i < levels[0].sums.size(); ++i) {
        const glm::vec4 sum = levels[0].sums[i];
        const glm::vec4 mean = sum / std::max(sum.w, 1.0f) + 0.5f;
        for (int c = 0; c < 3; ++c) rgba.push_back(static_cast<std::uint8_t>(mean[c]));
        rgba.push_back(static_cast<float>(image.rgba[4 * i + 3]) >= 255 * cutoff ? 255 : 0);
    }
    return rgba;
}

}  // namespace defocus::engine
