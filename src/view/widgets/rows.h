#pragma once
// Rows of the panel for settings (frame/settings.h) and fields of a lens (lens/lens_fields.h).

#include <string>
#include <string_view>

#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

// Draws the row of the setting with this name. Returns whether the request changed. Values that the setting refuses are
// ignored. `first`: for a setting that may be unset, its value when it is switched on.
bool settingRow(Request& request, const std::string& name, const std::string& first = "");

// Draws the row of a lens field. Returns whether the lens changed. Values that checkLens refuses are ignored.
bool lensFieldRow(Lens& lens, const LensField& field);

// Draws a combo box over the names of all methods. Returns whether one was chosen.
bool methodCombo(std::string& name);

// Draws the row of a method's setting.
void methodSettingRow(const MethodSetting& setting, std::string& value);

// Returns ImGui's format for seconds, with the photographic fraction in front: "1/125   %.3g s".
std::string secondsFormat(double seconds);

// Returns the label of a setting's name: "Blade rotation" for "bladeRotation".
std::string fieldLabel(std::string_view name);

}  // namespace defocus::engine
