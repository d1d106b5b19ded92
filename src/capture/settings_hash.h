#pragma once
// One text for all that a frame's pixels depend on: frames with equal settings are equal on machines of one kind.
// Stands in the metadata of each frame, so that --resume and `merge` know which belong together.

#include <cstdint>
#include <filesystem>
#include <string>

#include "capture/frame_sequence.h"
#include "frame/prepared_frame.h"

namespace defocus {

// What the frames of a film, or the parts of one frame, have in common.
struct FilmSettings {
    std::uint64_t world = 0;  // worldHash: meshes, materials, surroundings, shaders
    Request request;          // method and layer format; what a frame decides for itself isn't taken from here
    std::string encoding;     // what turns the image into the file's pixels, such as tone map and exposure; empty: EXR
};

// `frame` with its pyramids or without.
FilmSettings filmSettings(const PreparedFrame& frame, const Request& request,
                          const std::filesystem::path& shaderFolder);

// 16 hexadecimal digits.
std::string settingsHash(const FilmSettings& film, const SequenceFrame& frame);

}  // namespace defocus
