#pragma once
// Writes `defocus` commands that render a view or a recorded shot, for pasting into a shell.

#include <string>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"

namespace defocus::engine {

struct RenderCommandText {
    const Request& options;      // request that sets scene, method, levels of detail and samples
    const PreparedFrame& frame;  // prepared frame with the camera that options.camera names
    const View& view;            // view to render
    double pivotDistance = 1;    // distance in m from the camera to its target, > 0
    WriteOptions write;
    std::string output = "out.png";
};

// Returns the `defocus render` command for the view. Options with default values are left out.
std::string renderCommand(const RenderCommandText& text);

// Returns the `defocus capture` command for a recorded shot, with the options that shot files don't store.
std::string captureCommand(const std::filesystem::path& shot, const Request& options);

}  // namespace defocus::engine
