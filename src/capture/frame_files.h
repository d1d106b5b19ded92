#pragma once
// Names the files of a shot's frames and checks whether existing files are the wanted frames.

#include <filesystem>
#include <string>
#include <vector>

#include "render/tiles/part_header.h"

namespace defocus::engine {

// Throws Error for a pattern without #, with # in two places or in its folder, and for an ending that writeImage
// doesn't know. In "frames/####.exr", # stands for the digits of the frame's number, with leading zeros.
void checkFramePattern(const std::string& pattern);
std::filesystem::path framePath(const std::string& pattern, int frame);

// State of a frame's file.
enum class FrameState {
    missing,   // no file, or a damaged one
    finished,  // complete image of the wanted size and settings
    other,     // complete image of another size or other settings
};
FrameState frameState(const std::filesystem::path& path, int width, int height, const std::string& settings);

// Removes temporary files that a killed process has left beside these files. Keeps temporary files of running
// processes.
void removeUnfinished(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus::engine
