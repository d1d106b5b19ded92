#pragma once
// Presets name settings that belong together. Applying a preset sets them, and later settings override it. A request
// doesn't remember a preset; it has one as long as all of the preset's settings are as the preset sets them.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/request.h"

namespace defocus::engine {

struct PresetValue {
    std::string setting;  // its name in the table
    std::string text;     // as Setting::text writes it
};

struct Preset {
    std::string name;
    std::string description;
    std::vector<PresetValue> values;
};

// Returns all presets; their names are the choices of the setting "preset".
std::span<const Preset> presets();

// Throws UsageError for an unknown name.
const Preset& presetNamed(std::string_view name);

void applyPreset(const Preset& preset, Request& request);

// Takes the preset's settings back to those of a default-made request.
void clearPreset(const Preset& preset, Request& request);

// Returns the first preset whose settings the request has; null if there is none.
const Preset* presetOf(const Request& request);

}  // namespace defocus::engine
