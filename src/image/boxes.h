#pragma once
// What two images differ by once both are blurred: an error that a blur doesn't hide.

#include "image/image.h"

namespace defocus::engine {

// The root of the mean square of the differences of the means of boxes of `size`² pixels, of the first three channels,
// in linear light. A rest of less than a box at the right and the bottom is left out. Both images have the same size,
// of at least one box.
double boxDifference(const ImageView& reference, const ImageView& test, int size);

}  // namespace defocus::engine
