#pragma once
// The light and the dark look of the interface: colours, sizes and font.

#include <imgui.h>

#include <glm/vec3.hpp>

namespace defocus::engine {

// Sets ImGui's style; `scale`: px per unit of the interface. ImGuiCol_CheckMark is the accent colour, and
// ImGuiCol_PlotHistogramHovered warns.
void setStyle(bool dark, double scale);

// Returns the display values behind picture and panel.
glm::vec3 windowColor(bool dark);

// Adds the system's sans serif font, or ImGui's bitmap font where there is none.
void addFont(ImFontAtlas& atlas, double scale);

}  // namespace defocus::engine
