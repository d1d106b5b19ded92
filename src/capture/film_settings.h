#pragma once
// What the frames of a film, or the parts of one frame, have in common: for the settings in their metadata.

#include <filesystem>

#include "capture/frame_settings.h"
#include "frame/prepared_frame.h"
#include "frame/request.h"
#include "render/methods.h"

namespace defocus {

// `frame` with its pyramids or without.
FilmSettings filmSettings(const PreparedFrame& frame, const Request& options, const MethodUse& use,
                          const std::filesystem::path& shaderFolder);

}  // namespace defocus
