#pragma once
// Computes a hash of everything that determines a frame's pixels. Frames with equal hashes have equal pixels on
// machines of the same kind. The hash is stored in the metadata of frames and of parts of frames, so that --resume and
// `merge` can match files.

#include <cstdint>
#include <filesystem>
#include <string>

#include "frame/setup/frame_moment.h"
#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Settings that are the same for all frames of a shot, or for all parts of a frame.
struct FilmSettings {
    std::uint64_t world = 0;      // worldHash of meshes, materials, environment and shaders
    Request request;              // request with the method, the layer format and other settings that affect pixels
    std::string encoding;         // how pixels are encoded, such as tone map and exposure; empty: linear EXR
    std::string lensImages = {};  // identifies the lens images of refocused frames (RefocusRun::text()); else empty
};

// Returns the settings that `frame` has in common with the other frames of its shot. The pyramids of `frame` need not
// be built.
FilmSettings filmSettings(const PreparedFrame& frame, const Request& request,
                          const std::filesystem::path& shaderFolder);

// Returns the hash as 16 hexadecimal digits.
std::string settingsHash(const FilmSettings& film, const FrameMoment& moment);

}  // namespace defocus::engine
