#pragma once
// Every setting of a request, one row each. The command line, shots and their schema, image metadata, the settings
// hash, *Copy as command*, the window, Python's keywords and docs/settings.md are made from these rows: a new setting
// is a member of Request (include/defocus/) and a row of setting_rows.cpp.
//
// Values go in and out as text, as the command line has it. What writes a value and what reads it back agree: for each
// row and request, set(request, text(request)) changes nothing.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "defocus/setting_info.h"
#include "frame/request.h"

namespace defocus {

enum class SettingGroup { scene, camera, lens, samples, method, display, developer };

struct Setting {
    std::string name;    // in shots, metadata and extras: "blurThreshold"; snake_case in Python
    std::string option;  // on the command line: "--blur-threshold"; "SCENE" where no option stands before the value
    SettingGroup group = SettingGroup::scene;
    SettingKind kind = SettingKind::text;
    std::string metavar;  // the form of the value in --help: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double least = 0;     // range of numbers and whole numbers
    double most = 0;
    std::vector<std::string> choices;  // of a number: words that may stand in its place
    std::string help;
    std::string shotPlace;   // JSON pointer in a shot, "/animation/clip"; empty: shots don't have it
    bool keyed = false;      // a shot may give it keys
    bool repeated = false;   // may be given several times, each adding to the last
    bool lensField = false;  // a row of lens/lens_fields.h: cameras of files have values of their own
    bool everyday = false;   // what most people use: --help shows it, and --help-all the rest too
    // Reads a value. Throws Error saying what is allowed.
    std::function<void(Request&, const std::string&)> set;
    // The value as set() reads it; none where it is left open.
    std::function<std::optional<std::string>(const Request&)> text;
    // Leaves the value open again, or makes it that of a default-made request.
    std::function<void(Request&)> clear;
    // Of a repeated setting: all values.
    std::function<std::vector<std::string>(const Request&)> texts;
};

// All of them, in the order in which --help shows them. Settings of methods (MethodSetting) aren't among them.
std::span<const Setting> settings();

// Null where there is none of this name.
const Setting* settingNamed(std::string_view name);

// Sets a value by name; names of method settings ("far-components", or "farComponents") count too. Throws UsageError
// that begins with the name, for an unknown one with the nearest known.
void setByName(Request& request, std::string_view name, const std::string& text);

// The text of a request's value; nothing where it is left open or is that of a default-made request.
std::optional<std::string> changedText(const Setting& setting, const Request& request);

// "blurThreshold" → "blur_threshold"
std::string snakeCase(std::string_view name);

// Heading of a group in --help and docs: "Samples and level of detail".
std::string groupTitle(SettingGroup group);

}  // namespace defocus
