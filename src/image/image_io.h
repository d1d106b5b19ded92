#pragma once
// Image files through OpenImageIO: linear float EXR with metadata, tone-mapped PNG and JPEG, textures and HDR
// environments.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "image/image.h"
#include "image/tone_map.h"

namespace defocus::engine {

// Metadata by EXR attribute name. Standard names are used where EXR has them (OpenEXR "Standard Attributes"): isoSpeed,
// aperture (f-number), focus (m), nominalFocalLength (mm), expTime, comments, worldToCamera …; others carry the prefix
// "defocus:". A double is stored as EXR's float under a standard name (which EXR asks for), as a double under a
// prefixed one. EXR's matrices multiply row vectors and lie row by row, which is glm's memory layout, so a glm matrix M
// for columns (M·v) is stored as it is; mind that EXR's camera space looks along +z and is left-handed.
using MetadataValue = std::variant<int, double, std::string, glm::mat4>;
using Metadata = std::map<std::string, MetadataValue>;

using defocus::compareImages;
using defocus::readImage;
using defocus::writeImage;

// readImage of the public API with the file's attributes, under EXR's names (a PNG holds numbers as text).
Image readImage(const std::filesystem::path& path, Metadata& metadata);

// writeImage of the public API with metadata: EXR files hold all of it (capDate is added where it isn't given), PNG
// files as text, JPEG files only `comments`.
void writeImage(const std::filesystem::path& path, const ImageView& image, const Metadata& metadata,
                const WriteOptions& options = {});

// Images of one size by name, such as the sums of parts of a frame: a layer's channels are NAME.R, NAME.G, NAME.B and
// NAME.A in one EXR file, 32-bit float, ZIP, lossless. Names hold no dot at their end; reading keeps the names' order
// in the alphabet. Throw Error as readImage and writeImage do, and for a file without such layers.
struct ImageLayer {
    std::string name;
    Image image;  // 3 or 4 channels
};
void writeLayers(const std::filesystem::path& path, const std::vector<ImageLayer>& layers, const Metadata& metadata);
std::vector<ImageLayer> readLayers(const std::filesystem::path& path, Metadata* metadata = nullptr);

// Throws Error unless `path` has an extension that writeImage knows.
void checkImageExtension(const std::filesystem::path& path);

// Decodes a PNG or JPEG in memory (16 bits are reduced to 8). `name` is for the error message. `take` is told
// how many pixels it has before memory is taken for them, and may throw.
TextureImage decodeTexture(std::span<const std::byte> encoded, const std::string& name,
                           const std::function<void(std::uint64_t pixels)>& take = {});

}  // namespace defocus::engine
