#pragma once
// Defines presets, which are named groups of settings. Applying a preset sets all its settings; settings given later
// override them. A request doesn't store the name of a preset: it matches a preset as long as all the preset's settings
// have the preset's values.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/request.h"

namespace defocus::engine {

struct PresetValue {
    std::string setting;  // name of a setting in the settings table
    std::string text;     // value in the format of Setting::text
};

struct Preset {
    std::string name;
    std::string description;
    std::vector<PresetValue> values;
};

// Returns all presets. Their names are the choices of the setting "preset".
std::span<const Preset> presets();

// Returns the preset with that name. Throws UsageError for an unknown name.
const Preset& presetNamed(std::string_view name);

void applyPreset(const Preset& preset, Request& request);

// Resets all settings of the preset to their defaults.
void clearPreset(const Preset& preset, Request& request);

// Returns the first preset whose values all equal the request's values; null if no preset matches.
const Preset* presetOf(const Request& request);

}  // namespace defocus::engine
