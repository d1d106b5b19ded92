#pragma once
// Draws text into images, such as labels of contact sheets, in a sans-serif system font.

#include <filesystem>
#include <optional>
#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// Returns the path of a sans-serif TrueType font with Latin and Greek letters, if one is installed in a common
// location.
std::optional<std::filesystem::path> sansSerifFile();

// Draws one line of UTF-8 text with `value` in all channels. Position (x, y) is the left end of the baseline in px from
// the image's top left corner. Text is clipped to the image. `size` is the font size (em) in px. Returns false and
// draws nothing if no font is available.
bool writeText(Image& image, int x, int y, std::string_view text, double size, float value);

}  // namespace defocus::engine
