#pragma once
// Sets the interface's light or dark theme: colours, sizes and font.

#include <imgui.h>

#include <glm/vec3.hpp>

namespace defocus::engine {

// Sets ImGui's style. `scale`: px per interface unit. ImGuiCol_CheckMark becomes the accent colour,
// ImGuiCol_PlotHistogramHovered the warning colour.
void setStyle(bool dark, double scale);

// Returns the background colour of the window as display-encoded (sRGB) values.
glm::vec3 windowColor(bool dark);

// Adds the system's sans-serif font or, if there is none, ImGui's bitmap font. `scale`: px per interface unit.
void addFont(ImFontAtlas& atlas, double scale);

}  // namespace defocus::engine
