#pragma once
// Reads the metadata of opened image files, for image_read.cpp and image_rows.cpp. Private to src/image.

#include <OpenImageIO/imageio.h>

#include "image/exr_structure.h"
#include "image/image_io.h"

namespace defocus::engine {

// Returns the attributes of an opened file under their EXR names.
Metadata metadataOf(const OIIO::ImageSpec& spec);

// Checks the header of an EXR file within its first `headBytes` bytes, opens the file and sets `spec` to its first
// image. Throws Error if the file is unreadable or not an EXR file.
std::unique_ptr<OIIO::ImageInput> openExr(const std::filesystem::path& path, OIIO::ImageSpec& spec,
                                          std::size_t headBytes = usualHeadBytes);

}  // namespace defocus::engine
