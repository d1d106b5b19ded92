#pragma once
// The settings table: one row for each value of a request. The command line, shots and their schema, image metadata,
// the settings hash, the window, Python's keywords and docs/settings.md are made from these rows. A new setting needs a
// member of Request (include/defocus/request.h), a row in rows.cpp, and the code that uses it.
//
// Values are read and written as text, in the form of the command line: set(request, *text(request)) changes nothing.

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

// The results that a setting affects.
enum class SettingEffect {
    pixels,   // the linear image
    display,  // only PNG, JPEG and video
    run,      // only how the image is computed: time, memory, caches
};

// Inputs that decide whether a setting has an effect.
struct SettingContext {
    const Request& request;
    const Method& method;
    const Scene& scene;
    const Lens& lens;
};

struct Setting {
    // Returns the REASON in the warning "--option has no effect: REASON"; empty if the setting has an effect.
    using Unused = std::function<std::string(const SettingContext&)>;

    std::string name;    // name in shots, metadata and glTF extras: "blurThreshold"; snake_case in Python
    std::string option;  // name on the command line: "--blur-threshold"; "SCENE" for a positional argument
    SettingGroup group = SettingGroup::scene;
    SettingKind kind = SettingKind::text;
    std::string metavar;  // form of the value in --help: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // range of numbers and integers
    double max = 0;
    std::vector<std::string> choices;  // allowed words; for a number: words that may replace it
    std::string help;
    bool everyday = false;              // shown by --help; --help-all shows all
    std::string example;                // example value, for settings without default and choices
    std::vector<std::string> excludes;  // names of settings that cannot be given together with this one
    SettingEffect effect = SettingEffect::pixels;
    bool recorded = true;     // written to image metadata
    bool repeated = false;    // may be given several times; each value is added to the others
    bool lensField = false;   // field of lens/lens_fields.h; a file's camera may set it too
    std::string shotPlace;    // JSON pointer in a shot, "/animation/clip"; empty: not in shots
    bool keyed = false;       // whether a shot may animate the setting
    std::string schema;       // JSON schema of the value; empty: derived from the kind
    char arraySeparator = 0;  // separates array elements in the text; 0: the JSON value is no array
    Unused unused = {};       // empty: the setting always has an effect

    // Sets the value from a text. Throws Error that names the allowed values.
    std::function<void(Request&, const std::string&)> set;
    // Returns the value in the form that set() reads; none if the value is open.
    std::function<std::optional<std::string>(const Request&)> text;
    // Restores the value of a default Request.
    std::function<void(Request&)> clear;
    // Returns all values of a repeated setting.
    std::function<std::vector<std::string>(const Request&)> texts;
};

// Returns all rows in the order of --help. Settings of methods (MethodSetting) are not included.
std::span<const Setting> settings();

// Adds a row at the end. Only for programs that extend the table before its first use, such as tests.
void addSetting(Setting setting);

// Returns the setting of that name; null for an unknown name.
const Setting* settingNamed(std::string_view name);

// Returns whether a value suits only one scene, such as a camera, a lens or a clip. The window clears these settings when
// it opens another file.
bool dependsOnScene(const Setting& setting);

// Sets a value by name. Names of method settings ("far-components" or "farComponents") are allowed too. Throws
// UsageError for a bad value or an unknown name. For an unknown name, the message suggests the nearest name.
void setByName(Request& request, std::string_view name, const std::string& text);

// Returns the text of a request's value; none if the value is open or the default.
std::optional<std::string> changedText(const Setting& setting, const Request& request);

// Returns the names and values of all settings that affect the pixels. Paths are left out, because file contents are
// hashed elsewhere.
std::string pixelSettings(const Request& request);

// Converts "blurThreshold" to "blur_threshold".
std::string snakeCase(std::string_view name);

// Returns the group's heading in --help and docs: "Samples and level of detail".
std::string groupTitle(SettingGroup group);

}  // namespace defocus::engine
