#pragma once
// Warns about images that are mostly white or black.

#include <string>
#include <vector>

#include "image/image_io.h"

namespace defocus::engine {

// Returns a warning with a suggested exposure if `image` (linear), converted to 8 bits, would be mostly white or black:
// over 50 % of the covered pixels white, or over 95 % black. A mostly black image gets a warning only if the suggested
// exposure exceeds the current one. Pixels with alpha 0 are ignored.
std::vector<std::string> clippingWarnings(const ImageView& image, const WriteOptions& write);

}  // namespace defocus::engine
