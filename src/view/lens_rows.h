#pragma once
// Rows of the panel for the fields of a lens (lens/lens_fields.h).

#include <string>
#include <string_view>

#include "lens/lens_fields.h"

namespace defocus {

// A row for a field of the table. True when the lens was changed; it stays possible (checkLens).
bool lensFieldRow(Lens& lens, const LensField& field);

// As ImGui prints seconds, beginning as photographers say them: "1/125   0.008 s".
std::string secondsFormat(double seconds);

// "Blade rotation" of "bladeRotation".
std::string fieldLabel(std::string_view name);

}  // namespace defocus
