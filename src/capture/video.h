#pragma once
// Encodes image files of frames as a video with the ffmpeg program. The file extension selects the format. Videos other
// than GIF have BT.709 colours, and an odd width or height grows by one pixel.

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "image/image_io.h"

namespace defocus::engine {

// Throws Error unless ffmpeg is installed and `path` is a writable .mp4, .mov, .mkv, .webm or .gif file.
void checkVideo(const std::filesystem::path& path);

struct VideoFrame {
    std::filesystem::path file;
    WriteOptions image;  // conversion of a linear frame to display values
};

// Reads the frames in order and pipes them to ffmpeg. `frameRate`: frames per second. The video file appears only when
// it is complete. Throws Error with the path of an unreadable frame, or with the video's path and ffmpeg's message.
void writeVideo(const std::filesystem::path& path, const std::vector<VideoFrame>& frames, double frameRate,
                const Progress& progress = {});

}  // namespace defocus::engine
