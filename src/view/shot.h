#pragma once
// Key frames taken in a window, as a shot file that `defocus capture` renders (docs/shot.schema.json).

#include <string>
#include <vector>

#include "frame/prepared_frame.h"
#include "image/image_io.h"

namespace defocus {

struct ShotKey {
    View view;
    double pivotDistance = 1;  // m ahead of the camera: its target
    double time = 0;           // s into the animation
};

inline constexpr int framesBetweenKeys = 48;  // two seconds

struct ShotRecording {
    const Request& options;  // scene, clip, samples, levels, method
    const Lens& cameraLens;  // of the camera that options.camera names: what a shot falls back to
    const std::vector<ShotKey>& keys;
    double animationSpeed = 1;
    WriteOptions write;
    double metresPerUnit = 1;  // of the scene
};

// Camera, focus and those lens values that differ between the keys are keyframed; the other values are fixed. The
// animation plays from the time of the first key. At least one key; the image has the size of the last one's.
std::string shotJson(const ShotRecording& recording);

}  // namespace defocus
