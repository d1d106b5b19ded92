#pragma once
// Presets: settings that belong together, by name. Setting a preset sets them; what is set after it wins, and a request
// remembers no preset: it has one while all of its settings are as the preset has them.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/request.h"

namespace defocus {

struct PresetValue {
    std::string setting;  // its name in the table
    std::string text;     // as Setting::text writes it
};

struct Preset {
    std::string name;
    std::string description;
    std::vector<PresetValue> values;
};

// All of them; their names are the choices of the setting "preset".
std::span<const Preset> presets();

// Throws UsageError for an unknown name.
const Preset& presetNamed(std::string_view name);

void applyPreset(const Preset& preset, Request& request);

// Takes the preset's settings back to those of a default-made request.
void clearPreset(const Preset& preset, Request& request);

// The first whose settings the request has; null where there is none.
const Preset* presetOf(const Request& request);

}  // namespace defocus
