#pragma once
// Key frames taken in a window, as a shot file that `defocus capture` renders (docs/shot.schema.json).

#include <string>
#include <vector>

#include "app/prepared_frame.h"
#include "image/image_io.h"

namespace defocus {

struct ShotKey {
    View view;
    double pivotDistance = 1;  // m ahead of the camera: its target
};

inline constexpr int framesBetweenKeys = 48;  // two seconds

// Camera, focus and those lens values that differ between the keys are keyframed; the other values are fixed. At least
// one key; the image has the size of the last one's.
std::string shotJson(const SceneOptions& options, const std::vector<ShotKey>& keys, const WriteOptions& write);

}  // namespace defocus
