#pragma once
// The options of the command line that fill a request: the rows of the table of settings.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "frame/settings.h"

namespace defocus {

// Adds an option for each of the settings named: a command offers none that it doesn't follow. Options that say the
// same thing in different ways exclude each other. `request` holds the defaults that --help shows and must outlive the
// parse.
void addSettings(CLI::App& command, Request& request, const std::vector<std::string>& names);

// The names of all settings of `groups` but those in `without`.
std::vector<std::string> settingsOf(const std::vector<SettingGroup>& groups,
                                    const std::vector<std::string>& without = {});

// An option for each setting of each method; methods may share one.
void addMethodSettings(CLI::App& command, Request& request);

// All groups but the display of PNG and JPEG.
inline const std::vector<SettingGroup> frameGroups = {SettingGroup::scene,  SettingGroup::camera,
                                                      SettingGroup::lens,   SettingGroup::samples,
                                                      SettingGroup::method, SettingGroup::developer};
// What picks a scene.
inline const std::vector<std::string> sceneSettings = {"scene", "fishCount", "trianglesPerFish"};

}  // namespace defocus
