#pragma once
// Texture → Image and back. The one place where OpenGL's bottom-up rows become top-down.

#include "gl/texture.h"
#include "image/image.h"

namespace defocus::engine {

// Layer 0 of a float or normalised texture with `channels` (1, 3 or 4) channels as floats.
Image readBack(const GlTexture& texture, int channels);

// An image of the texture's size and channels as its only level.
void upload(GlTexture& texture, const Image& image);

}  // namespace defocus::engine
