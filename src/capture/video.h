#pragma once
// Makes a film from written frames with the ffmpeg program. The file's ending selects the format.

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "image/image_io.h"

namespace defocus::engine {

// Throws Error unless `path` is an .mp4, .mov, .mkv, .webm or .gif that can be written and ffmpeg is installed.
void checkVideo(const std::filesystem::path& path);

struct VideoFrame {
    std::filesystem::path file;
    WriteOptions image;  // how a linear frame is converted to display values
};

// Reads the frames in order and pipes them to ffmpeg, with `frameRate` frames per second. The film's file appears only
// when it is complete. Throws Error that names the unreadable frame, or the film with ffmpeg's message.
void writeVideo(const std::filesystem::path& path, const std::vector<VideoFrame>& frames, double frameRate,
                const Progress& progress = {});

}  // namespace defocus::engine
