#pragma once
// Maps values to colours with perceptually uniform colour maps: magma and viridis by Stéfan van der Walt and Nathaniel
// Smith, from OpenImageIO. Lightness rises monotonically, so that the maps also work in greyscale and for colour-blind
// readers.

#include <glm/vec3.hpp>

#include "image/image.h"

namespace defocus::engine {

// magma() and viridis() map t in [0, 1] to linear Rec.709 RGB; t is clamped, and NaN counts as 0.
glm::vec3 magma(float t);    // black, purple, orange, pale yellow; for error maps
glm::vec3 viridis(float t);  // dark blue, green, yellow; for levels of detail and other quantities

// Maps a 1-channel image with values in [0, 1] to linear RGB by magma().
Image colourMapped(const Image& values);

}  // namespace defocus::engine
