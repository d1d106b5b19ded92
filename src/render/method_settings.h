#pragma once
// What a method can be asked for, by name and as text: the options of `render`, the methods of a bench and the metadata
// of an image say it alike, for example "circular:far-components=5,resolution=half".

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace defocus {

struct MethodSetting {
    std::string name;                  // "far-components"; on the command line --far-components
    std::string standard;              // its value when nothing is said
    std::string description;           // for --help
    std::vector<std::string> choices;  // one of these, or, when empty, a number:
    double least = 0;
    double most = 0;
    bool whole = true;  // a whole number
};

// Values by name, as text.
using MethodSettings = std::map<std::string, std::string>;

// `given` with the standard values filled in. Throws Error, naming `method`, for a name that isn't in `known` (it lists
// those that are) and for a value that the setting doesn't take.
MethodSettings completeSettings(std::string_view method, const std::vector<MethodSetting>& known,
                                const MethodSettings& given);

// The value of a setting that is a number; `settings` must be complete.
double numberOf(const MethodSettings& settings, const std::string& name);

// "taps=16,coc=thin-lens": what differs from the standard values, in the table's order; empty when nothing does.
std::string settingsText(const std::vector<MethodSetting>& known, const MethodSettings& settings);

}  // namespace defocus
