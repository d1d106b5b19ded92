#pragma once
// Writes a scene with baked lighting as a .glb file, so that other renderers can draw the same image as the benches.

#include <filesystem>

#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

// Writes the frame's meshes with the colours of unlitScene (eval/convergence/unlit_scene.h), and the frame's camera,
// with the lens settings in the camera's extras. Lengths are in metres. Throws Error for skins and morph targets, and
// if writing fails.
void writeUnlitFile(const std::filesystem::path& path, const PreparedFrame& frame);

}  // namespace defocus::engine
