#pragma once
// What writing whole images and writing them by rows share: kinds of files, and pixels as each has them. Private to
// src/image.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

enum class FileKind { exr, png, jpeg };

// By the extension. Throws Error for another one.
FileKind fileKind(const std::filesystem::path& path);
const char* formatName(FileKind kind);  // OpenImageIO's

// Of a file with these pixels; a JPEG keeps no fourth channel and of the metadata only `comments`.
OIIO::ImageSpec imageSpec(FileKind kind, int width, int height, int channels, const Metadata& metadata);

// The rows of a PNG or JPEG file from linear ones. `firstRow` is the number of the first of them in the file: what lies
// between two bytes is dithered by its place.
std::vector<std::uint8_t> displayBytes(FileKind kind, const ImageView& image, const WriteOptions& options,
                                       int firstRow);

}  // namespace defocus::engine
