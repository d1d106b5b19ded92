#pragma once
// Adds the command-line options that fill a request, from the rows of the settings table.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus::engine {

// Adds an option for each of the named settings. A command must name only settings that it uses. Options for the same
// value exclude each other. `request` holds the defaults for --help and must outlive the parse.
void addSettings(CLI::App& command, Request& request, const std::vector<std::string>& names);

// Returns the names of all settings of `groups`, except those in `without`.
std::vector<std::string> settingsOf(const std::vector<SettingGroup>& groups,
                                    const std::vector<std::string>& without = {});

// Adds an option for each setting of each method. Methods may share an option.
void addMethodSettings(CLI::App& command, Request& request);

// Adds the options for developers of the program. They must be added last, so that --help ends with them.
void addDeveloperSettings(CLI::App& command, Request& request, const std::vector<std::string>& without = {});

// Returns the setting that an option sets; null for an option of the command's own, even one of the same name.
const Setting* settingOf(const CLI::Option& option);

// Returns the method's setting that an option sets; null if it sets none.
const MethodSetting* methodSettingOf(const CLI::Option& option);

// Groups of the settings of a frame, without the display of PNG and JPEG and without developer settings.
inline const std::vector<SettingGroup> frameGroups = {SettingGroup::scene, SettingGroup::camera, SettingGroup::lens,
                                                      SettingGroup::samples, SettingGroup::method};
// Groups of the settings of a frame and of its display as PNG and JPEG.
inline const std::vector<SettingGroup> pictureGroups = {SettingGroup::display, SettingGroup::scene,
                                                        SettingGroup::camera,  SettingGroup::lens,
                                                        SettingGroup::samples, SettingGroup::method};
// Settings that select a scene.
inline const std::vector<std::string> sceneSettings = {"scene", "fishCount", "trianglesPerFish"};

}  // namespace defocus::engine
