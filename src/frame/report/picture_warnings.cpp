#include "frame/report/picture_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/luminance.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

constexpr float white = 254.5f / 255;  // min display-encoded value that rounds to 255
constexpr float black = 0.5f / 255;
constexpr double maxWhite = 0.5;  // max fraction of white pixels without a warning
constexpr double maxBlack = 0.95;
constexpr double wantedMedian = 0.18;  // middle grey, linear
constexpr double minLuminance = 1e-6;

// Returns the exposure (EV) that maps the median luminance of the lit pixels to middle grey.
double helpfulExposure(const ImageView& image) {
    std::vector<double> luminances;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double value = luminance(image.at(x, y));
            if (value > minLuminance && std::isfinite(value)) luminances.push_back(value);
        }
    if (luminances.empty()) return 0;
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::ranges::nth_element(luminances, middle);
    return std::log2(wantedMedian / *middle);
}

}  // namespace

std::vector<std::string> clippingWarnings(const ImageView& image, const WriteOptions& write) {
    const Image display = displayEncoded(image, write.toneMap, write.exposure);
    if (display.channels < 3) return {};
    std::size_t shown = 0, whites = 0, blacks = 0;
    for (int y = 0; y < display.height; ++y)
        for (int x = 0; x < display.width; ++x) {
            const float* pixel = display.at(x, y);
            if (display.channels > 3 && !(pixel[3] > 0)) continue;
            const auto [min, max] = std::minmax({pixel[0], pixel[1], pixel[2]});
            ++shown;
            whites += min >= white ? 1 : 0;
            blacks += max <= black ? 1 : 0;
        }
    const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(shown); };
    const auto line = [&](std::size_t count, const char* what) {
        return std::vector{fmt::format(
            "{:.0f} % of the image is {} at an exposure of {:.2g} EV; try --exposure auto or --exposure {:.2g}",
            100 * share(count), what, write.exposure, helpfulExposure(image))};
    };
    if (shown > 0 && share(whites) > maxWhite) return line(whites, "white");
    if (shown > 0 && share(blacks) > maxBlack && helpfulExposure(image) > write.exposure) return line(blacks, "black");
    return {};
}

}  // namespace defocus::engine
