#pragma once
// Names the files of a shot's frames, and checks whether existing files are the requested frames.

#include <filesystem>
#include <string>
#include <vector>

#include "render/tiles/part_header.h"

namespace defocus::engine {

// Throws Error unless the file name of `pattern` has exactly one sequence of # characters and an extension that
// writeImage supports. In "frames/####.exr", #### stands for the frame's number with leading zeros.
void checkFramePattern(const std::string& pattern);
std::filesystem::path framePath(const std::string& pattern, int frame);

// State of a frame's image file.
enum class FrameState {
    missing,   // no file, or a damaged file
    finished,  // complete image with the requested size and settings
    other,     // complete image whose size or settings differ from the requested ones
};
FrameState frameState(const std::filesystem::path& path, int width, int height, const std::string& settings);

}  // namespace defocus::engine
