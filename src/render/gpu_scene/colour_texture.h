#pragma once
// A colour map (image/colour_map.h) as a texture for shaders.

#include "gl/texture.h"
#include "image/colour_map.h"

namespace defocus::engine {

// Returns `map` sampled from 0 (left) to 1 (right): 256 x 1 texels, linear RGBA.
GlTexture colourMapTexture(glm::vec3 (*map)(float));

}  // namespace defocus::engine
