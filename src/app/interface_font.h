#pragma once
// The typeface of the window and of what is written into images: a sans serif of the system, else the bitmap font that
// Dear ImGui brings along.

#include <imgui.h>

namespace defocus {

// `size` in px. The atlas keeps it; Greek, arrows and other signs are in it where the system has a font. `config` says
// what else the atlas should know.
ImFont* addInterfaceFont(ImFontAtlas& atlas, double size, ImFontConfig config = {});

}  // namespace defocus
