#pragma once
// Two images prepared for all metrics: equal size, RGB and finite. Grey is replicated; alpha is dropped, which leaves
// the premultiplied colour over black. Non-finite pixels are marked and replaced, so that filters do not spread them.
// The replacement is the other image's colour, or black if both are non-finite.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

enum class PixelState : std::uint8_t { finite, nonFiniteInOne, nonFiniteInBoth };

struct ComparablePair {
    Image reference;                // 3 channels, linear
    Image test;                     // 3 channels, linear
    std::vector<PixelState> state;  // width · height entries
};

// Throws Error if the sizes differ, or if an image is empty or has the wrong number of values.
ComparablePair comparablePair(const ImageView& reference, const ImageView& test);

}  // namespace defocus::engine
