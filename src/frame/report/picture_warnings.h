#pragma once
// Warns of what a person should know about a finished picture.

#include <string>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

// Returns a line, with what helps, where most of an 8-bit picture of `image` (linear) would be white, or where nearly
// all of what the image shows would be black.
std::vector<std::string> clippingWarnings(const ImageView& image, const WriteOptions& write);

}  // namespace defocus::engine
