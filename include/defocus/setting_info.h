#pragma once
// The settings of a Request as data: bindings, forms and pages are made from it.

#include <optional>
#include <string>
#include <vector>

#include "defocus/export.h"

namespace defocus {

// The type of a value in JSON and in Python.
enum class SettingKind {
    number,
    integer,
    boolean,  // --name and --no-name
    text,     // any text; names and methods
    path,     // of a file or folder
    choice,   // one of the row's choices
    other,    // a form of its own, shown by the row's metavar: a size, a point, a colour …
};

struct SettingInfo {
    std::string name;     // for setSetting: "blurThreshold"; for a method's setting "far-components"
    std::string keyword;  // in Python: "blur_threshold"
    std::string option;   // on the command line: "--blur-threshold"; "SCENE" for a positional argument
    std::string group;    // heading: "Lens"
    SettingKind kind = SettingKind::text;
    std::string metavar;  // the form of the value: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // range of numbers and integers
    double max = 0;
    std::vector<std::string> choices;  // for a number: words that may replace it
    std::string help;
    std::optional<std::string> defaultValue;  // of a default Request; none if the value is open there
    std::vector<std::string> excludes;        // names of settings that cannot be given together with this one
    char arraySeparator = 0;                  // between the elements of a list; 0: a comma
    bool repeated = false;                    // may be set several times; each value is added to the others
    std::vector<std::string> methods;         // that take the setting; empty: all
};

// Returns everything that setSetting takes, in the order of `defocus render --help`: settings of requests, then those
// of methods.
DEFOCUS_API std::vector<SettingInfo> settingInfos();

}  // namespace defocus
