#pragma once
// Chooses the file kind and encodes pixels for image_write.cpp and image_rows.cpp. Private to src/image.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

enum class FileKind { exr, png, jpeg };

// Returns the file kind for the path's extension. Throws Error for unknown extensions.
FileKind fileKind(const std::filesystem::path& path);
const char* formatName(FileKind kind);  // OpenImageIO's name of the file format

// Returns OpenImageIO's description of an image file. JPEG files drop alpha and all metadata except `comments`.
OIIO::ImageSpec imageSpec(FileKind kind, int width, int height, int channels, const Metadata& metadata);

// Converts linear rows to the 8-bit values of a PNG or JPEG file. `firstRow` is the index of the first row within the
// file; the dither pattern depends on it.
std::vector<std::uint8_t> displayBytes(FileKind kind, const ImageView& image, const WriteOptions& options,
                                       int firstRow);

}  // namespace defocus::engine
