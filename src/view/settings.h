#pragma once
// What a window remembers from one run to the next, in $XDG_CONFIG_HOME/defocus/view.json (or ~/.config).

#include <filesystem>
#include <optional>

namespace defocus {

struct ViewSettings {
    bool dark = true;
    bool panel = true;
    double interfaceScale = 1;                 // 0.5 … 3
    std::optional<double> budgetMilliseconds;  // none: as the driver suggests
    int width = 0;                             // of the window, in its units; 0: never stored
    int height = 0;
};

// Empty where neither variable says where to store it.
std::filesystem::path viewSettingsPath();

// Values that are missing or make no sense are the standard ones; a file that isn't there is fine. Throws Error for one
// that is no JSON.
ViewSettings readViewSettings(const std::filesystem::path& path);
void writeViewSettings(const std::filesystem::path& path, const ViewSettings& settings);

}  // namespace defocus
