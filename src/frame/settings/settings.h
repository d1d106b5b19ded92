#pragma once
// The settings table has one row for each value of a request. The command line, shot files and their schema, image
// metadata, the settings hash, the window, Python's keywords and docs/settings.md are generated from it. A new setting
// needs a member of Request (include/defocus/request.h), a row in one of the files rows_*.cpp, and the code that uses
// the value.
//
// Values are parsed and formatted as text, in the format of the command line: set(request, *text(request)) changes
// nothing.

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

// Results that depend on a setting.
enum class SettingEffect {
    pixels,   // the setting changes the linear image
    display,  // the setting changes only 8-bit output: PNG, JPEG and video
    run,      // the setting changes only the time, memory and caches of a run, not the image
};

// Inputs for deciding whether a setting has an effect.
struct SettingContext {
    const Request& request;
    const Method& method;
    const Scene& scene;
    const Lens& lens;
};

struct Setting {
    // Returns the reason why the setting has no effect, for a warning; empty if the setting has an effect.
    using Unused = std::function<std::string(const SettingContext&)>;

    std::string name;    // name in shots, metadata and glTF extras: "blurThreshold"; snake_case in Python
    std::string option;  // name on the command line: "--blur-threshold"; "SCENE" for a positional argument
    SettingGroup group = SettingGroup::scene;
    SettingKind kind = SettingKind::text;
    std::string metavar;  // placeholder for the value in --help: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // allowed range, for SettingKind::number and ::integer
    double max = 0;
    std::vector<std::string> choices;  // allowed words; a numeric setting accepts numbers, too
    std::string help;
    bool everyday = false;              // true: listed by --help; false: only by --help-all
    std::string example;                // example value, for settings that have neither default nor choices
    std::vector<std::string> excludes;  // names of settings that cannot be given together with this one
    SettingEffect effect = SettingEffect::pixels;
    bool recorded = true;     // true: the setting is written to image metadata
    bool repeated = false;    // true: the option may be given several times; all values are kept
    bool lensField = false;   // true: a lens field (lens/lens_fields.h), which a camera in the scene file may also set
    std::string shotPlace;    // JSON pointer in a shot, "/animation/clip"; empty: not in shots
    bool keyed = false;       // true: a shot may animate the setting with keyframes
    std::string schema;       // JSON schema of the value; empty: derived from the kind
    char arraySeparator = 0;  // separates array elements in the text; 0: the JSON value isn't an array
    Unused unused = {};       // empty function: the setting always has an effect

    // Parses the text and sets the value. Throws Error, with the allowed values in its message, for an invalid text.
    std::function<void(Request&, const std::string&)> set;
    // Returns the value in the format that set() reads; nullopt if the value is unset.
    std::function<std::optional<std::string>(const Request&)> text;
    // Restores the default value.
    std::function<void(Request&)> clear;
    // Returns all values of a repeated setting, each in the format of text().
    std::function<std::vector<std::string>(const Request&)> texts;
};

// Returns all rows in the order of --help. Settings of methods (MethodSetting) are not included.
std::span<const Setting> settings();

// Returns a setting of a method as a row of the table.
Setting rowOf(const MethodSetting& setting);

// Appends a row. Only for programs that extend the table before its first use, such as tests.
void addSetting(Setting setting);

// Returns the setting with that name; null for an unknown name.
const Setting* settingNamed(std::string_view name);

// Returns whether a setting applies to one scene only, such as a camera, a lens or a clip. The window clears these
// settings when it opens another file.
bool dependsOnScene(const Setting& setting);

// Sets a value by the setting's name, or a method's setting by its name ("far-components" or "farComponents"). Throws
// UsageError for a bad value or an unknown name; the message suggests the nearest known name.
void setByName(Request& request, std::string_view name, const std::string& text);

// Returns the message of an error in a setting's value, with the setting's name in front, unless the message already
// begins with the name ("method circular has no settings …").
std::string namedError(std::string_view setting, std::string_view error);

// Returns the text of the setting's value in a request; nullopt if the value is unset or the default.
std::optional<std::string> changedText(const Setting& setting, const Request& request);

// Returns names and values of all settings that affect the pixels. Paths are left out, because file contents are hashed
// separately.
std::string pixelSettings(const Request& request);

// Converts a name to snake_case: "blurThreshold" to "blur_threshold".
std::string snakeCase(std::string_view name);

// Returns the group's heading in --help and docs, such as "Samples and level of detail".
std::string groupTitle(SettingGroup group);

}  // namespace defocus::engine
