#pragma once
// Machine-readable descriptions of all settings of a Request, from which bindings, forms and documentation are
// generated.

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
    other,    // special syntax, see SettingInfo::metavar: a size, a point, a colour …
};

struct SettingInfo {
    std::string name;     // name for setSetting: "blurThreshold"; for a method's setting: "far-components"
    std::string keyword;  // keyword argument in Python: "blur_threshold"
    std::string option;   // command-line option: "--blur-threshold"; positional argument: "SCENE"
    std::string group;    // heading in the help: "Lens"
    SettingKind kind = SettingKind::text;
    std::string metavar;  // syntax of the value: "N", "PX", "X,Y,Z", "a|b|c"
    std::string unit;     // "mm", "m", "s", "px", "degrees" …; empty: none
    double min = 0;       // range of a number or integer: [min, max]
    double max = 0;
    std::vector<std::string> choices;  // allowed values; for a number: words allowed in its place
    std::string help;
    std::optional<std::string> defaultValue;  // value in a default Request; nullopt: unset
    std::vector<std::string> excludes;        // names of settings that cannot be combined with this one
    char arraySeparator = 0;                  // separator of list elements; 0: comma
    bool repeated = false;                    // true: may be set several times; values accumulate
    std::vector<std::string> methods;         // rendering methods with this setting; empty: all
};

// Returns all settings that setSetting accepts, in the order of `defocus render --help`; settings of methods are last.
DEFOCUS_API std::vector<SettingInfo> settingInfos();

}  // namespace defocus
