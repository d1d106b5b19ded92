#pragma once
// The table of settings: one row for each value of a request. The command line, shots and their schema, image metadata,
// the settings hash, the window, Python's keywords and docs/settings.md are made from these rows. A new setting is a
// member of Request (include/defocus/request.h), a row in rows.cpp, and the code that uses it.
//
// Values go in and out as text, in the form of the command line: set(request, *text(request)) changes nothing.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/setting_info.h"
#include "frame/request.h"

namespace defocus::engine {

enum class SettingGroup { scene, camera, lens, samples, method, display, developer };

// What depends on a setting.
enum class SettingEffect {
    pixels,   // the linear image
    display,  // only PNG, JPEG and video made of it
    run,      // only how the image is computed: time, memory, caches
};

// What decides whether a setting has an effect.
struct SettingContext {
    const Request& request;
    const Method& method;
    const Scene& scene;
    const Lens& lens;
};

struct Setting {
    // Returns why the setting has no effect, as "REASON" in "--option has no effect: REASON"; empty if it has one.
    using Unused = std::function<std::string(const SettingContext&)>;

    std::string name;    // in shots, metadata and glTF extras: "blurThreshold"; snake_case in Python
    std::string option;  // on the command line: "--blur-threshold"; "SCENE" for a positional argument
    SettingGroup group = SettingGroup::scene;
    SettingKind kind = SettingKind::text;
    std::string metavar;  // the form of the value in --help: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // range of numbers and integers
    double max = 0;
    std::vector<std::string> choices;  // for a number: words that may replace it
    std::string help;
    bool everyday = false;              // shown by --help; --help-all shows all
    std::string example;                // a value to begin with, for settings without default and choices
    std::vector<std::string> excludes;  // names of settings that cannot be given together with this one
    SettingEffect effect = SettingEffect::pixels;
    bool recorded = true;     // in image metadata
    bool repeated = false;    // may be given several times; each value is added to the others
    bool lensField = false;   // a row of lens/lens_fields.h, for which cameras of files have their own values
    std::string shotPlace;    // JSON pointer in a shot, "/animation/clip"; empty: not in shots
    bool keyed = false;       // a shot may animate it
    std::string schema;       // JSON schema of the value; empty: by kind
    char arraySeparator = 0;  // separates the text of a JSON array's elements; 0: the value is no array
    Unused unused = {};       // empty: the setting always has an effect

    // Reads a value. Throws Error that says what is allowed.
    std::function<void(Request&, const std::string&)> set;
    // Returns the value as set() reads it; none if it is left open.
    std::function<std::optional<std::string>(const Request&)> text;
    // Restores the value of a default Request.
    std::function<void(Request&)> clear;
    // For a repeated setting: all values.
    std::function<std::vector<std::string>(const Request&)> texts;
};

// Returns all rows in the order in which --help shows them. Settings of methods (MethodSetting) are not among them.
std::span<const Setting> settings();

// Adds a row behind the others. Only for programs that extend the table before its first use, such as tests.
void addSetting(Setting setting);

// Returns null for an unknown name.
const Setting* settingNamed(std::string_view name);

// Sets a value by name; names of method settings ("far-components" or "farComponents") count too. Throws UsageError
// that begins with the name; for an unknown name it suggests the nearest.
void setByName(Request& request, std::string_view name, const std::string& text);

// Returns the text of a request's value; none if it is open or has its default.
std::optional<std::string> changedText(const Setting& setting, const Request& request);

// Returns the names and values of all settings that affect the pixels. Files count by their content, not by their
// names.
std::string pixelSettings(const Request& request);

// "blurThreshold" → "blur_threshold"
std::string snakeCase(std::string_view name);

// Returns the group's heading in --help and docs: "Samples and level of detail".
std::string groupTitle(SettingGroup group);

}  // namespace defocus::engine
