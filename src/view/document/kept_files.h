#pragma once
// Reads and writes the JSON files that the window keeps between runs. Settings and saved views are stored in
// $XDG_CONFIG_HOME/defocus (~/.config), recent scenes in $XDG_STATE_HOME/defocus (~/.local/state).

#include "view/state/view_state.h"

namespace defocus::engine {

// Each of these functions returns the path of a file; empty if neither the XDG variable nor the home folder is known.
std::filesystem::path viewSettingsPath();
std::filesystem::path savedViewsPath();
std::filesystem::path recentFilesPath();

struct ViewSettings {
    bool dark = true;
    bool panel = true;
    double interfaceScale = 1;                 // scale factor of the interface, 0.5 … 3
    std::optional<double> budgetMilliseconds;  // time budget per frame, ms; nullopt: see windowBudget()
    int width = 0;                             // window size in window units; 0: not stored
    int height = 0;
};

// Reads the settings; missing and invalid values get their defaults. Throws Error for a file that isn't a JSON object.
ViewSettings readViewSettings(const std::filesystem::path& file);
// Writes the settings. Throws Error if the file can't be written.
void writeViewSettings(const std::filesystem::path& file, const ViewSettings& settings);

// Returns the key of a scene's saved views: its absolute path, or "school" for the built-in scene.
std::string savedViewsKey(const std::filesystem::path& scene);

// Returns the saved views of a scene, without invalid ones. Throws Error for a file that isn't a JSON object.
std::vector<SavedView> readSavedViews(const std::filesystem::path& file, const std::string& key);

// Replaces the saved views of one scene. Throws Error if the file can't be read or written.
void writeSavedViews(const std::filesystem::path& file, const std::string& key, const std::vector<SavedView>& views);

inline constexpr std::size_t maxRecentFiles = 12;

// Returns the recent scenes that exist, latest first; empty if the list can't be read.
std::vector<std::filesystem::path> readRecentFiles(const std::filesystem::path& list);

// Moves or adds a scene to the front of the list. Throws Error if the list can't be written.
void rememberRecentFile(const std::filesystem::path& list, const std::filesystem::path& scene);

}  // namespace defocus::engine
