#pragma once
// Adds the command-line options that fill a request; generated from the settings table.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "frame/settings/settings.h"
#include "render/methods.h"

namespace defocus::engine {

// Adds an option for each of the settings `names`. Options that set the same value exclude each other. `request`
// provides the defaults in --help and must exist until the command line is parsed.
void addSettings(CLI::App& command, Request& request, const std::vector<std::string>& names);

// Rewrites boolean options with a value, because CLI flags take no value: "--dof false" and "--dof=false" become
// "--no-dof", and "--dof true" becomes "--dof".
std::vector<std::string> withoutBooleanValues(const std::vector<std::string>& words);

// Returns the names of all settings of `groups`, except those in `without`.
std::vector<std::string> settingsOf(const std::vector<SettingGroup>& groups,
                                    const std::vector<std::string>& without = {});

// Adds an option for each setting of each method. Settings with the same name in several methods share one option.
void addMethodSettings(CLI::App& command, Request& request);

// Adds the options for developers of the program, except the settings `without`. Call this last, so that --help ends
// with these options.
void addDeveloperSettings(CLI::App& command, Request& request, const std::vector<std::string>& without = {});

// Returns the setting that an option sets; null for an option that the command defines itself, even if the option has a
// setting's name.
const Setting* settingOf(const CLI::Option& option);

// Returns the method setting that an option sets; null if it sets none.
const MethodSetting* methodSettingOf(const CLI::Option& option);

// Groups of all settings that affect a frame, except the developer settings and the conversion to PNG and JPEG.
inline const std::vector<SettingGroup> frameGroups = {SettingGroup::scene, SettingGroup::camera, SettingGroup::lens,
                                                      SettingGroup::samples, SettingGroup::method};
// Groups of all settings that affect a frame or its conversion to PNG and JPEG.
inline const std::vector<SettingGroup> pictureGroups = {SettingGroup::display, SettingGroup::scene,
                                                        SettingGroup::camera,  SettingGroup::lens,
                                                        SettingGroup::samples, SettingGroup::method};
// Settings that select the scene.
inline const std::vector<std::string> sceneSettings = {"scene", "fishCount", "trianglesPerFish"};

}  // namespace defocus::engine
