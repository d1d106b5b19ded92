#pragma once
// Difference of two images after a box blur: the error that a blur does not hide.

#include "image/image.h"

namespace defocus::engine {

// Returns the RMS difference of the means of `size` x `size` px boxes, over the first three channels in linear light.
// Incomplete boxes at the right and bottom edges are ignored. Both images must have the same size, at least one box.
double boxDifference(const ImageView& reference, const ImageView& test, int size);

}  // namespace defocus::engine
