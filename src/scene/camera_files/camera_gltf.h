#pragma once
// Writes a camera as glTF.

#include <string>

#include "scene/camera_files/camera_take.h"

namespace defocus::engine {

// Returns the text of a .gltf file with one camera node. Lens values are extras of the camera. If `take` has several
// samples, they become an animation of the node and, by KHR_animation_pointer, of the lens values. Animated values have
// 32-bit precision.
std::string cameraGltfText(const CameraTake& take);

}  // namespace defocus::engine
