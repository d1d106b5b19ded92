#pragma once
// Colour map (image/colour_map.h) as a texture for shaders.

#include "gl/texture.h"
#include "image/colour_map.h"

namespace defocus::engine {

// Returns a texture of map(t), t from 0 (left) to 1 (right): 256 x 1 texels, linear RGBA.
GlTexture colourMapTexture(glm::vec3 (*map)(float));

}  // namespace defocus::engine
