#pragma once
// Draws the panel rows of settings (frame/settings/settings.h) and of lens fields (lens/lens_fields.h).

#include <string>
#include <string_view>

#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

// Draws the row of the setting `name`. Returns whether the request changed. Values that the setting rejects are
// ignored. `first`: value that the setting gets when its checkbox is turned on; empty: no checkbox, since the setting
// always has a value. The overload without `first` uses Setting::example, which is given for every setting that may be
// unset.
bool settingRow(Request& request, const std::string& name);
bool settingRow(Request& request, const std::string& name, const std::string& first);

// Draws the row of a lens field. Returns whether the lens changed. Values that checkLens rejects are ignored.
bool lensFieldRow(Lens& lens, const LensField& field);

// Draws a combo box with the names of all methods. Returns whether the user chose one.
bool methodCombo(std::string& name);

// Draws the row of a method's setting.
void methodSettingRow(const MethodSetting& setting, std::string& value);

// Returns ImGui's format string for a time in seconds, such as "1/125   %.3g s". The string begins with the
// photographic fraction.
std::string secondsFormat(double seconds);

// Returns the label for a setting's name: "Blade rotation" for "bladeRotation".
std::string fieldLabel(std::string_view name);

}  // namespace defocus::engine
