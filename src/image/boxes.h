#pragma once
// Computes the difference of two images after box filtering, which averages out noise finer than the boxes.

#include "image/image.h"

namespace defocus::engine {

// Divides both images into boxes of `size` x `size` px and returns the RMS difference between the boxes' means, over
// the first three channels in linear light. Incomplete boxes at the right and bottom edges are ignored. Both images
// must have the same size and contain at least one complete box.
double boxDifference(const ImageView& reference, const ImageView& test, int size);

}  // namespace defocus::engine
