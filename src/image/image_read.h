#pragma once
// Code shared by reading complete images and reading rows. Private to src/image.

#include <OpenImageIO/imageio.h>

#include "image/image_io.h"

namespace defocus::engine {

// Returns a file's attributes under EXR names.
Metadata metadataOf(const OIIO::ImageSpec& spec);

}  // namespace defocus::engine
