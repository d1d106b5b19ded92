#pragma once
// Views that people keep by name: a camera and its lens, of each scene, in $XDG_CONFIG_HOME/defocus/views.json beside
// the window's settings.

#include <filesystem>
#include <string>
#include <vector>

#include "lens/lens.h"
#include "view/camera_controls.h"

namespace defocus {

struct SavedView {
    std::string name;
    ViewCamera camera;
    double nearPlane = 0.01;  // m
    Lens lens;                // without the image of its aperture, which stays as it is
};

// Empty where the settings have no place either.
std::filesystem::path savedViewsPath();

// What a scene's views are kept under: its absolute path, or a word for the built-in one.
std::string savedViewsKey(const std::filesystem::path& scene);

// None where there is no such file. Views that make no sense are left out. Throws Error for a file that is no JSON.
std::vector<SavedView> readSavedViews(const std::filesystem::path& file, const std::string& key);

// Replaces those of one scene; the others' stay. Throws Error where that fails.
void writeSavedViews(const std::filesystem::path& file, const std::string& key, const std::vector<SavedView>& views);

}  // namespace defocus
