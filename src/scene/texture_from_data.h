#pragma once
// Converts float images to the 8-bit textures that a Scene stores.

#include <string>

#include "defocus/scene_data.h"
#include "image/image.h"

namespace defocus::engine {

// Returns the texture's image: colours are encoded in sRGB with straight alpha; other data is stored unchanged. Values
// are rounded to 8 bits. Throws UsageError, with a message that begins with `label`, for an image without pixels, a
// wrong number of pixels or channels, and values outside [0, 1].
TextureImage textureImage(const TextureData& texture, const std::string& label);

}  // namespace defocus::engine
