#pragma once
// Settings of a request as a shot has them: JSON values by the kind of the setting.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "capture/json_reader.h"
#include "frame/settings.h"

namespace defocus {

// The value under `reader` as Setting::set reads it. Throws Error naming the place for what the setting doesn't take;
// paths stay as they stand there.
std::string settingText(const Setting& setting, const JsonReader& reader);

// The inverse.
nlohmann::ordered_json settingJson(const Setting& setting, const std::string& text);

}  // namespace defocus
