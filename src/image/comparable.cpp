#include "image/comparable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.h"
#include "core/parallel.h"
#include "image/packed_pixels.h"

namespace defocus::engine {

namespace {

// Copies a pixel's grey or RGB colour to `rgb`. Returns false if a channel is NaN or infinite.
bool copyColour(const float* pixel, int channels, float* rgb) {
    for (int c = 0; c < 3; ++c) rgb[c] = pixel[channels == 1 ? 0 : c];
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

}  // namespace

void checkComparable(const ImageView& reference, const ImageView& test) {
    if (reference.width != test.width || reference.height != test.height)
        fail("images of different sizes cannot be compared: {}x{} and {}x{}", reference.width, reference.height,
             test.width, test.height);
    if (reference.empty()) fail("images without pixels cannot be compared");
    for (const ImageView& image : {reference, test})
        if (!coversItsPixels(image))
            fail("{} values are too few for an image of {}x{} px with {} channels", image.pixels.size(), image.width,
                 image.height, image.channels);
}

ComparablePair comparablePair(const ImageView& reference, const ImageView& test) {
    checkComparable(reference, test);
    const int width = reference.width;
    ComparablePair pair{Image(width, reference.height, 3), Image(width, reference.height, 3), {}};
    pair.state.resize(pair.reference.pixels.size() / 3);
    parallelFor(static_cast<std::size_t>(reference.height), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            float* a = pair.reference.at(x, y);
            float* b = pair.test.at(x, y);
            const bool finiteA = copyColour(reference.at(x, y), reference.channels, a);
            const bool finiteB = copyColour(test.at(x, y), test.channels, b);
            if (finiteA && finiteB) continue;
            if (finiteA) std::copy_n(a, 3, b);
            if (finiteB) std::copy_n(b, 3, a);
            if (!finiteA && !finiteB) {
                std::fill_n(a, 3, 0.0f);
                std::fill_n(b, 3, 0.0f);
            }
            pair.state[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
                finiteA || finiteB ? PixelState::nonFiniteInOne : PixelState::nonFiniteInBoth;
        }
    });
    return pair;
}

}  // namespace defocus::engine
