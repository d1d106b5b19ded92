#pragma once
// A film from frames that are already written, through the ffmpeg program: what kind of film, the file's ending says.

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "image/image_io.h"

namespace defocus::engine {

// Throws Error unless `path` is an .mp4, .mov, .mkv, .webm or .gif that can be written and ffmpeg is installed.
void checkVideo(const std::filesystem::path& path);

struct VideoFrame {
    std::filesystem::path file;
    WriteOptions image;  // how a linear frame is turned into display values
};

// Reads the frames in order and pipes them to ffmpeg, `frameRate` a second. The film appears whole or not at all.
// Throws Error naming the frame that can't be read, or the film with what ffmpeg said.
void writeVideo(const std::filesystem::path& path, const std::vector<VideoFrame>& frames, double frameRate,
                const Progress& progress = {});

}  // namespace defocus::engine
