#pragma once
// Reads the metadata of opened image files, for image_read.cpp and image_rows.cpp. Private to src/image.

#include <OpenImageIO/imageio.h>

#include "image/image_io.h"

namespace defocus::engine {

// Returns the attributes of an opened file under their EXR names.
Metadata metadataOf(const OIIO::ImageSpec& spec);

}  // namespace defocus::engine
