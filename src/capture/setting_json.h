#pragma once
// Settings as JSON values in shots, by the columns of the table of settings.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "capture/json_reader.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

// Returns the JSON schema of the setting's value.
nlohmann::ordered_json valueSchema(const Setting& setting);

// Returns the value as text for Setting::set. Throws Error naming the place if the setting doesn't take it. Paths are
// not resolved.
std::string settingText(const Setting& setting, const JsonReader& reader);

// Returns the JSON value of a setting's text: the inverse of settingText.
nlohmann::ordered_json settingJson(const Setting& setting, const std::string& text);

}  // namespace defocus::engine
