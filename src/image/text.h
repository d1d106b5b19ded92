#pragma once
// Words in images: labels of contact sheets, in a sans serif of the system.

#include <filesystem>
#include <optional>
#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// The TrueType file of a sans serif with Latin and Greek letters, if the system has one in the usual places.
std::optional<std::filesystem::path> sansSerifFile();

// One line of UTF-8, `value` in all channels of the image, over what is there. It begins at `x` and stands on the line
// `y` (px from the top left corner); what lies outside the image is left out. `size` is the typeface's em, px. False,
// and nothing is drawn, without a typeface.
bool writeText(Image& image, int x, int y, std::string_view text, double size, float value);

}  // namespace defocus::engine
