#pragma once
// Colour maps for data that people look at: magma and viridis of Stéfan van der Walt and Nathaniel Smith, as
// OpenImageIO has them. Both are perceptually uniform and rise in lightness, so that they also read in grey and with
// colour blindness.

#include <glm/vec3.hpp>

#include "image/image.h"

namespace defocus::engine {

// t in [0, 1] (clamped; NaN counts as 0) → LINEAR Rec.709 RGB.
glm::vec3 magma(float t);    // black, purple, orange, pale yellow: errors
glm::vec3 viridis(float t);  // dark blue, green, yellow: levels and other quantities

// A 1-channel image of values in [0, 1] through magma, as linear RGB for writeImage.
Image colourMapped(const Image& values);

}  // namespace defocus::engine
