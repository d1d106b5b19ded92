#pragma once
// Writes recorded keyframes as a shot file for `defocus capture` (docs/shot.schema.json).

#include <string>
#include <vector>

#include "view/state/view_state.h"

namespace defocus::engine {

inline constexpr int framesBetweenKeys = 48;  // frames between two keyframes: 2 s at 24 frames per second

struct ShotRecording {
    const Request& options;  // provides scene, clip, samples, levels and method
    const Lens& cameraLens;  // lens of the camera options.camera; its values are the defaults of the shot
    const std::vector<ShotKey>& keys;
    double animationSpeed = 1;
    WriteOptions write;
    double metresPerUnit = 1;  // metres per unit of the scene
};

// Returns the shot as JSON. Camera, focus and the lens values that differ between the keys are written as keyframes;
// other lens values are written as constants. The animation starts at the time of the first key. The image has the size
// stored with the last key. Needs at least one key.
std::string shotJson(const ShotRecording& recording);

}  // namespace defocus::engine
