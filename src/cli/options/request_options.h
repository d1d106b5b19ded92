#pragma once
// The options of the command line that fill a request: the rows of the table of settings.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "frame/settings/settings.h"

namespace defocus::engine {

// Adds an option for each of the settings named: a command offers none that it doesn't follow. Options that say the
// same thing in different ways exclude each other. `request` holds the defaults that --help shows and must outlive the
// parse.
void addSettings(CLI::App& command, Request& request, const std::vector<std::string>& names);

// The names of all settings of `groups` but those in `without`.
std::vector<std::string> settingsOf(const std::vector<SettingGroup>& groups,
                                    const std::vector<std::string>& without = {});

// An option for each setting of each method; methods may share one.
void addMethodSettings(CLI::App& command, Request& request);

// What only those need who measure or mend the program: to be added last, so that --help ends with them.
void addDeveloperSettings(CLI::App& command, Request& request, const std::vector<std::string>& without = {});

// What a frame needs, without the display of PNG and JPEG and what only developers need.
inline const std::vector<SettingGroup> frameGroups = {SettingGroup::scene, SettingGroup::camera, SettingGroup::lens,
                                                      SettingGroup::samples, SettingGroup::method};
// The same with the display.
inline const std::vector<SettingGroup> pictureGroups = {SettingGroup::display, SettingGroup::scene,
                                                        SettingGroup::camera,  SettingGroup::lens,
                                                        SettingGroup::samples, SettingGroup::method};
// What picks a scene.
inline const std::vector<std::string> sceneSettings = {"scene", "fishCount", "trianglesPerFish"};

}  // namespace defocus::engine
