#pragma once
// Computes Cryptomattes: masks of objects or materials as pairs of a hashed name and its coverage, sorted by coverage.
// Source: Cryptomatte specification 1.2.0 (Friedman and Jones 2015, Fully Automatic ID Mattes with Support for Motion
// Blur and Transparency).

#include <string>
#include <string_view>
#include <vector>

#include "image/image_io.h"
#include "render/layer_images.h"

namespace defocus::engine {

// Returns the name's MurmurHash3 as a float that is neither denormal, infinite nor NaN.
float cryptomatteId(std::string_view name);

struct Cryptomatte {
    std::vector<Image> ranks;  // RGBA images, each with id and coverage of two ranks
    std::string manifest;      // JSON: name → id in hexadecimal digits
};

// Returns the masks of a frame. `names`: names of the objects or materials, by index. Objects or materials with the
// same name share a mask.
Cryptomatte cryptomatte(const NumberCounts& counts, const Image& samples, const std::vector<std::string>& names);

// Adds the metadata of a matte whose layers begin with `layer`, such as "CryptoObject".
void addCryptomatteMetadata(const std::string& layer, const std::string& manifest, Metadata& metadata);

}  // namespace defocus::engine
