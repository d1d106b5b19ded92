#pragma once
// Transfers between textures and images. All conversions between OpenGL's bottom-up rows and top-down images are here.

#include "gl/texture.h"
#include "image/half_image.h"
#include "image/image.h"

namespace defocus::engine {

// Returns layer 0 of a float, normalised or depth texture as an image with 1, 3 or 4 channels.
Image readBack(const GlTexture& texture, int channels);
// Returns layer 0 of an RGBA float texture as half floats, with row 0 at the bottom as in OpenGL.
HalfImage readHalves(const GlTexture& texture);

// Uploads an image into a texture that has one mip level and the image's size and channels.
void upload(GlTexture& texture, const Image& image);

}  // namespace defocus::engine
