#pragma once
// Image files through OpenImageIO: linear float EXR with metadata, tone-mapped PNG and JPEG, textures and HDR environments.

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>

#include "image/image.h"
#include "image/tone_map.h"

namespace defocus {

// Metadata by EXR attribute name. Standard names are used where EXR has them (OpenEXR "Standard Attributes"): isoSpeed,
// aperture (f-number), focus (m), nominalFocalLength (mm), expTime … ; others carry the prefix "defocus:".
using Metadata = std::map<std::string, std::variant<int, double, std::string>>;

// Reads any file OpenImageIO knows as linear float with 1, 3 or 4 channels (8-bit formats are decoded from sRGB).
// `metadata`, where given, receives the file's attributes. Throws Error naming the file and the fault.
Image readImage(const std::filesystem::path& path, Metadata* metadata = nullptr);

struct WriteOptions {
    ToneMap toneMap = ToneMap::none;  // PNG and JPEG only
    double exposure = 0;              // EV; PNG and JPEG only
};

// Writes by extension: .exr (32-bit float, ZIP, linear, metadata), .png and .jpg (tone-mapped, sRGB-encoded, 8 bit). The file
// appears whole or not at all. Throws Error naming the file and the fault; unknown extensions list the known ones.
void writeImage(const std::filesystem::path& path, const Image& image, const Metadata& metadata = {},
                const WriteOptions& options = {});

// Throws Error unless `path` has an extension that writeImage knows.
void checkImageExtension(const std::filesystem::path& path);

// Decodes an encoded image in memory (PNG, JPEG …; 16 bits are reduced to 8). `name` is for the error message.
TextureImage decodeTexture(std::span<const std::byte> encoded, const std::string& name);

}  // namespace defocus
