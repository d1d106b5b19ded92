#pragma once
// Converts settings to and from JSON values in shots, by the columns of the settings table.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "capture/json_reader.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

// Returns the JSON schema of the setting's value.
nlohmann::ordered_json valueSchema(const Setting& setting);

// Returns the value as text for Setting::set. Throws Error with the value's place if the setting doesn't accept it.
// Paths are not resolved.
std::string settingText(const Setting& setting, const JsonReader& reader);

// Returns the JSON value of a setting's text. Inverse of settingText.
nlohmann::ordered_json settingJson(const Setting& setting, const std::string& text);

}  // namespace defocus::engine
