#pragma once
// Neutral ground disk for scenes without a floor; it receives their shadows.

#include "scene/pose.h"

namespace defocus::engine {

// Adds a mesh, a material and a node (Node::ground): a horizontal, diffuse, grey disk centred below `pose` at its
// lowest point. Its radius is 30 times that of the scene, so that framing cameras see it up to the horizon. `pose` must
// be a pose of this scene; an empty pose adds nothing.
void addGround(Scene& scene, const Pose& pose);

// Removes the ground again; it must be the last mesh, material and node of the scene.
void removeGround(Scene& scene);

// Returns whether addGround has added a ground.
bool hasGround(const Scene& scene);

}  // namespace defocus::engine
