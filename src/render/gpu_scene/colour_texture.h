#pragma once
// Colour map (image/colour_map.h) as a texture for shaders.

#include "gl/texture.h"
#include "image/colour_map.h"

namespace defocus::engine {

// Returns a texture of 256 x 1 texels (linear RGBA) with the colours map(t), from t = 0 on the left to t = 1 on the
// right.
GlTexture colourMapTexture(glm::vec3 (*map)(float));

}  // namespace defocus::engine
