#pragma once
// Writes the `defocus render` command that makes the picture of a view, to paste into a shell.

#include <string>

#include "frame/setup/prepared_frame.h"
#include "image/image_io.h"

namespace defocus::engine {

struct RenderCommandText {
    const Request& options;      // scene, method, levels, samples
    const PreparedFrame& frame;  // with the camera that options.camera names
    const View& view;            // as it is now
    double pivotDistance = 1;    // m, > 0: how far ahead the target lies
    WriteOptions write;
    std::string output = "out.png";
};

// Returns the command. Options that have their standard value are left out.
std::string renderCommand(const RenderCommandText& text);

// Returns the command that films a shot which was recorded in a view. It has the options that no shot file holds.
std::string captureCommand(const std::filesystem::path& shot, const Request& options);

// Returns a word so that a shell reads it back: as it is, or in single quotes.
std::string shellWord(const std::string& word);

}  // namespace defocus::engine
