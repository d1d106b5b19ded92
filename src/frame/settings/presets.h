#pragma once
// Presets: named groups of settings. Applying a preset sets all its settings; later settings override them. A request
// doesn't store a preset's name. The request has a preset while all of the preset's settings have the preset's values.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/request.h"

namespace defocus::engine {

struct PresetValue {
    std::string setting;  // name of the setting in the settings table
    std::string text;     // value as Setting::text writes it
};

struct Preset {
    std::string name;
    std::string description;
    std::vector<PresetValue> values;
};

// Returns all presets; their names are the choices of the setting "preset".
std::span<const Preset> presets();

// Returns the preset of that name. Throws UsageError for an unknown name.
const Preset& presetNamed(std::string_view name);

void applyPreset(const Preset& preset, Request& request);

// Resets the preset's settings to their defaults.
void clearPreset(const Preset& preset, Request& request);

// Returns the first preset whose settings the request has; null if there is none.
const Preset* presetOf(const Request& request);

}  // namespace defocus::engine
