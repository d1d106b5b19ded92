#pragma once
// A hash of everything that a frame's pixels depend on. Frames with equal hashes have equal pixels on machines of one
// kind. The metadata of frames and of their parts hold it, so that --resume and `merge` know what belongs together.

#include <cstdint>
#include <filesystem>
#include <string>

#include "frame/driver/frame_moment.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// What all frames of a film, and all parts of one frame, share.
struct FilmSettings {
    std::uint64_t world = 0;  // worldHash: meshes, materials, surroundings, shaders
    Request request;          // for method and layer format; the moment has the rest
    std::string encoding;     // how pixels are encoded, such as tone map and exposure; empty: linear EXR
};

// `frame` may lack its pyramids.
FilmSettings filmSettings(const PreparedFrame& frame, const Request& request,
                          const std::filesystem::path& shaderFolder);

// Returns 16 hexadecimal digits.
std::string settingsHash(const FilmSettings& film, const FrameMoment& moment);

}  // namespace defocus::engine
