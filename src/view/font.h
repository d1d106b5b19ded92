#pragma once
// The typeface of the window: a sans serif of the system, else the bitmap font that Dear ImGui brings along.

#include <imgui.h>

namespace defocus {

// `size` in px. The atlas keeps it; Greek, arrows and other signs are in it where the system has a font.
void addViewFont(ImFontAtlas& atlas, double size);

}  // namespace defocus
