#pragma once
// The options of the command line that fill SceneOptions.

#include <CLI/CLI.hpp>
#include <filesystem>

#include "frame/scene_options.h"

namespace defocus {

// --cache-dir, by itself. `folder` must outlive the parse.
CLI::Option* addCacheFolder(CLI::App& command, std::filesystem::path& folder);

// Those of it that a camera's lens and focus depend on, but for SCENE, --fish and --camera.
void addCameraOptions(CLI::App& command, SceneOptions& options);

// Adds the options in groups. `options` must outlive the parse.
void addSceneOptions(CLI::App& command, SceneOptions& options);

// Makes the command's --exposure and those of a photographic exposure exclude each other.
void excludeExposure(CLI::App& command);

// An option for each setting of each method; methods may share one.
void addMethodSettings(CLI::App& command, SceneOptions& options);

}  // namespace defocus
