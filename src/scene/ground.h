#pragma once
// Adds a neutral ground disk, which receives shadows, to scenes without a floor.

#include "scene/pose.h"

namespace defocus::engine {

// Adds a horizontal, diffuse, grey disk to the scene, as a mesh, a material and a node with Node::ground. The disk is
// centred below `pose` at the height of the pose's lowest point. Its radius is 30 times the scene's, so that it reaches
// the horizon for the default camera. `pose` must be a pose of `scene`. Adds nothing if the pose has no objects.
void addGround(Scene& scene, const Pose& pose);

// Removes the ground, which must be the last mesh, material and node of the scene; without a ground, does nothing.
void removeGround(Scene& scene);

// Returns whether addGround has added a ground.
bool hasGround(const Scene& scene);

}  // namespace defocus::engine
