#pragma once
// Prepares two images of equal size for image metrics by converting them to finite RGB. Grey is copied to all three
// channels. Alpha is dropped, so premultiplied colours appear over black. A pixel with NaN or infinity is marked and
// replaced by the corresponding pixel of the other image, or by black if both are non-finite. Filters therefore do not
// spread NaN and infinity.

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace defocus::engine {

enum class PixelState : std::uint8_t { finite, nonFiniteInOne, nonFiniteInBoth };

struct ComparablePair {
    Image reference;                // linear image with 3 channels
    Image test;                     // linear image with 3 channels
    std::vector<PixelState> state;  // width · height entries, top row first
};

// Throws Error if the sizes differ, or if an image is empty or has the wrong number of values.
void checkComparable(const ImageView& reference, const ImageView& test);

// Returns both images, converted to finite RGB as described above. Throws Error in the same cases as checkComparable.
ComparablePair comparablePair(const ImageView& reference, const ImageView& test);

}  // namespace defocus::engine
