#pragma once
// Chooses the file kind and encodes pixels for image_write.cpp and image_rows.cpp. Private to src/image.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
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

// Returns the complete encoded file, so that the caller stores it with one checked write. Image libraries report write
// errors late or not at all. `writePixels` writes all pixels to the output and returns false on failure. Throws Error,
// whose message begins with `failure`.
std::vector<unsigned char> encode(const std::string& failure, const char* format, const OIIO::ImageSpec& spec,
                                  const std::function<bool(OIIO::ImageOutput&)>& writePixels);

}  // namespace defocus::engine
