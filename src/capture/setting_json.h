#pragma once
// Converts the values of settings to and from JSON values in shots, using the settings table.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "capture/json_reader.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

// Returns the JSON schema for the values of a setting.
nlohmann::ordered_json valueSchema(const Setting& setting);

// Returns the value in the text format of Setting::set. Throws Error, with the value's location in its message, if the
// setting doesn't accept the value. Paths are not resolved.
std::string settingText(const Setting& setting, const JsonReader& reader);

// Converts a setting's text to a JSON value. Inverse of settingText.
nlohmann::ordered_json settingJson(const Setting& setting, const std::string& text);

}  // namespace defocus::engine
