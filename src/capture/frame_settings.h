#pragma once
// One text for all that a frame's pixels depend on: frames with equal settings are equal on machines of one kind.
// Stands in the metadata of each frame, so that --resume and `merge` know which belong together.

#include <cstdint>
#include <string>

#include "capture/frame_sequence.h"

namespace defocus {

// What the frames of a shot share.
struct FilmSettings {
    std::uint64_t world = 0;  // worldHash: meshes, materials, surroundings, shaders
    std::string program;      // its version
    std::string method;       // MethodUse::text
    std::string layerFormat;
    std::string encoding;  // what turns the image into the file's pixels, such as tone map and exposure; empty for EXR
};

// 16 hexadecimal digits.
std::string frameSettings(const FilmSettings& film, const SequenceFrame& frame);

}  // namespace defocus
