#pragma once
// Computes a hash of everything that a frame's pixels depend on. Frames with equal hashes have equal pixels on machines
// of one kind. The metadata of frames and of their parts hold the hash, so that --resume and `merge` can match files.

#include <cstdint>
#include <filesystem>
#include <string>

#include "frame/setup/frame_moment.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Settings that all frames of a film, and all parts of one frame, share.
struct FilmSettings {
    std::uint64_t world = 0;  // worldHash: meshes, materials, environment, shaders
    Request request;          // for method, layer format and other settings that affect pixels
    std::string encoding;     // pixel encoding, such as tone map and exposure; empty: linear EXR
};

// Returns the settings that `frame` shares with the other frames of its film. `frame` may lack its pyramids.
FilmSettings filmSettings(const PreparedFrame& frame, const Request& request,
                          const std::filesystem::path& shaderFolder);

// Returns the hash as 16 hexadecimal digits.
std::string settingsHash(const FilmSettings& film, const FrameMoment& moment);

}  // namespace defocus::engine
