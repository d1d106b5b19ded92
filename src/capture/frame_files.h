#pragma once
// The files of a shot's frames: their names, and whether one that is there is the frame that is wanted.

#include <filesystem>
#include <string>
#include <vector>

#include "render/tiles/part_header.h"

namespace defocus::engine {

// "frames/####.exr": the frame's number, with zeros in front, stands for the #. Throws Error for a pattern without #,
// with # in two places or in its folder, and for an ending that writeImage doesn't know.
void checkFramePattern(const std::string& pattern);
std::filesystem::path framePath(const std::string& pattern, int frame);

// What is there under a frame's name.
enum class FrameState {
    missing,   // nothing, or a file that is damaged
    finished,  // a whole image of the size and the settings that are wanted
    other,     // a whole image, but not that
};
FrameState frameState(const std::filesystem::path& path, int width, int height, const std::string& settings);

// Removes what a process that was killed left beside these files: temporary ones of their names. What another process
// is writing just now stays.
void removeUnfinished(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus::engine
