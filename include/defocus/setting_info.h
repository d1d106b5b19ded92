#pragma once
// What a Request can be asked for, as data: bindings, forms and pages are made from it.

#include <optional>
#include <string>
#include <vector>

#include "defocus/export.h"

namespace defocus {

// What a value looks like in JSON and in Python.
enum class SettingKind {
    number,
    whole,   // a whole number
    truth,   // true or false: --name and --no-name
    text,    // any text; names and methods
    path,    // of a file or folder
    choice,  // one of the row's choices
    other,   // its own form, which the row's metavar shows: a size, a point, a colour …
};

struct SettingInfo {
    std::string name;     // as setSetting takes it: "blurThreshold"; of a method's setting "far-components"
    std::string keyword;  // in Python: "blur_threshold"
    std::string option;   // on the command line: "--blur-threshold"; "SCENE" where no option stands before the value
    std::string group;    // heading of those that belong together: "Lens"
    SettingKind kind = SettingKind::text;
    std::string metavar;  // the form of the value: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double least = 0;     // range of numbers and whole numbers
    double most = 0;
    std::vector<std::string> choices;  // of a number: words that may stand in its place
    std::string help;
    std::optional<std::string> standard;  // of a default-made request; none where that leaves the value open
    bool repeated = false;                // may be set several times, each adding to the last
    std::vector<std::string> methods;     // that take it; empty: it isn't a method's
};

// All that setSetting takes, in the order of `defocus render --help`: those of requests, then those of methods.
DEFOCUS_API std::vector<SettingInfo> settingInfos();

}  // namespace defocus
