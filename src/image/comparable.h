#pragma once
// Two images of one size, brought to what every metric can digest: RGB (grey repeated, alpha dropped: a premultiplied
// colour is the colour over black) and finite. A pixel that is not finite in one image takes the other image's colour,
// so that it spoils no neighbour through a filter, and is marked; a pixel that is not finite in both is black in both.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

enum class PixelState : std::uint8_t { finite, nonFiniteInOne, nonFiniteInBoth };

struct ComparablePair {
    Image reference;                // 3 channels, linear
    Image test;                     // 3 channels, linear
    std::vector<PixelState> state;  // width · height
};

// Throws Error when the sizes differ, or an image is empty or has not as many values as its size says.
ComparablePair comparablePair(const ImageView& reference, const ImageView& test);

}  // namespace defocus::engine
