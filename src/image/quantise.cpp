#include "image/quantise.h"

#include <algorithm>
#include <cmath>

namespace defocus::engine {

namespace {

// Returns interleaved gradient noise in [0, 1), evenly distributed over each 3 × 3 px neighbourhood.
double gradientNoise(int x, int y) {
    const double inner = 0.06711056 * x + 0.00583715 * y;
    const double outer = 52.9829189 * (inner - std::floor(inner));
    return outer - std::floor(outer);
}

}  // namespace

std::vector<std::uint8_t> quantised(const Image& display, int firstRow) {
    constexpr int betweenChannels = 47;  // offset between channels in px; makes their dither patterns differ
    constexpr double ownValue = 1e-3;    // in units of 1/255; values this close to a multiple of 1/255 are not dithered
    std::vector<std::uint8_t> bytes;
    bytes.reserve(display.pixels.size());
    for (int y = 0; y < display.height; ++y)
        for (int x = 0; x < display.width; ++x)
            for (int c = 0; c < display.channels; ++c) {
                const double value = 255 * double{display.pixels[bytes.size()]};
                const double nearest = std::round(value);
                const bool exact = c == 3 || std::abs(value - nearest) < ownValue;
                const double shown =
                    exact ? nearest : std::floor(value + gradientNoise(x + c * betweenChannels, firstRow + y));
                bytes.push_back(static_cast<std::uint8_t>(std::clamp(shown, 0.0, 255.0)));
            }
    return bytes;
}

}  // namespace defocus::engine
