#pragma once
// Writes `defocus` commands that render a view or film a shot, to paste into a shell.

#include <string>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"

namespace defocus::engine {

struct RenderCommandText {
    const Request& options;      // scene, method, levels, samples
    const PreparedFrame& frame;  // with the camera that options.camera names
    const View& view;            // view to render
    double pivotDistance = 1;    // m, > 0: distance from the camera to its target
    WriteOptions write;
    std::string output = "out.png";
};

// Returns the `defocus render` command. Options that have their default are left out.
std::string renderCommand(const RenderCommandText& text);

// Returns the `defocus capture` command for a shot that was recorded in a view. It has the options that shot files
// don't hold.
std::string captureCommand(const std::filesystem::path& shot, const Request& options);

// Returns a word in shell syntax: unchanged, or in single quotes.
std::string shellWord(const std::string& word);

}  // namespace defocus::engine
