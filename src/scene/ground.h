#pragma once
// A ground for scenes that hang in the air: a neutral disk beneath them, which catches their shadows.

#include "scene/pose.h"

namespace defocus::engine {

// Adds a mesh, a material and a node (Node::ground): a level, matt, grey disk at the lowest point
// of `pose`, the scene's own at some time, and about its middle. It reaches 30 times as far as what stands on it, so
// that cameras that frame the scene see it up to the horizon. Nothing is added where the pose shows nothing.
void addGround(Scene& scene, const Pose& pose);

// Takes the ground away again, the last mesh, material and node of the scene.
void removeGround(Scene& scene);

// Has it been added?
bool hasGround(const Scene& scene);

}  // namespace defocus::engine
