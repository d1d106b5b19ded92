#pragma once
// Machine-readable descriptions of all settings of a Request. Bindings, forms and documentation are generated from
// them.

#include <optional>
#include <string>
#include <vector>

#include "defocus/export.h"

namespace defocus {

// Type of a setting's value in JSON and in Python.
enum class SettingKind {
    number,
    integer,
    boolean,  // --name and --no-name on the command line
    text,     // free text, such as a name or a method
    path,     // path of a file or folder
    choice,   // one of SettingInfo::choices
    other,    // special syntax, given by SettingInfo::metavar: a size, a point, a colour …
};

struct SettingInfo {
    std::string name;     // as setSetting takes it: "blurThreshold"; a method's setting: "far-components"
    std::string keyword;  // keyword argument in Python: "blur_threshold"
    std::string option;   // on the command line: "--blur-threshold"; a positional argument: "SCENE"
    std::string group;    // heading in the help: "Lens"
    SettingKind kind = SettingKind::text;
    std::string metavar;  // syntax of the value: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // range of a number or integer: [min, max]
    double max = 0;
    std::vector<std::string> choices;  // allowed values; for a number: words accepted in its place
    std::string help;
    std::optional<std::string> defaultValue;  // value in a default Request; none if it is unset there
    std::vector<std::string> excludes;        // names of settings that cannot be combined with this one
    char arraySeparator = 0;                  // separator between the elements of a list; 0: a comma
    bool repeated = false;                    // true: may be given several times, and the values accumulate
    std::vector<std::string> methods;         // rendering methods that use the setting; empty: all
};

// Returns all settings that setSetting accepts, in the order of `defocus render --help`. The settings of methods come
// last.
DEFOCUS_API std::vector<SettingInfo> settingInfos();

}  // namespace defocus
