#pragma once
// File kinds and pixel encoding, shared by writing complete images and writing rows. Private to src/image.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

enum class FileKind { exr, png, jpeg };

// Returns the file kind for the path's extension. Throws Error for unknown extensions.
FileKind fileKind(const std::filesystem::path& path);
const char* formatName(FileKind kind);  // name in OpenImageIO

// Returns the OpenImageIO description of a file. JPEG drops alpha and all metadata except `comments`.
OIIO::ImageSpec imageSpec(FileKind kind, int width, int height, int channels, const Metadata& metadata);

// Encodes linear rows as PNG or JPEG bytes. `firstRow` is the index of the first row in the file, which determines the
// dither pattern.
std::vector<std::uint8_t> displayBytes(FileKind kind, const ImageView& image, const WriteOptions& options,
                                       int firstRow);

}  // namespace defocus::engine
