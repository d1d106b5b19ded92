#pragma once
// Prepares the textures of cut-outs (glTF's alphaMode MASK), so that their mip levels preserve coverage and colour.

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace defocus::engine {

// Returns the image as 8-bit RGBA with alpha 255 where alpha / 255 is at least `cutoff`, and 0 elsewhere, so that
// averages of alpha are the fraction of visible texels. Hidden texels get the mean colour of the visible texels nearby,
// because their own colour, often black, must not darken averages of colour.
std::vector<std::uint8_t> cutOut(const TextureImage& image, float cutoff);

}  // namespace defocus::engine
