#pragma once
// What reading whole images and reading them by rows share. Private to src/image.

#include <OpenImageIO/imageio.h>

#include "image/image_io.h"

namespace defocus::engine {

// A file's attributes, under EXR's names.
Metadata metadataOf(const OIIO::ImageSpec& spec);

}  // namespace defocus::engine
