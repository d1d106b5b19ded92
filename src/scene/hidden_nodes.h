#pragma once
// Nodes whose objects are left out of pictures, as people switch them off in a tree of the scene.

#include <span>
#include <string>

#include "scene/pose.h"

namespace defocus::engine {

// Takes the objects of these nodes, and of all nodes below them, out of the pose. Bounds that it had are those of what
// is left; cameras and lights stay. A node is called by its name, or, where it has none or shares it, by its number in
// Scene::nodes, "7" or "#7". Throws Error for a name that the scene doesn't have.
void hideNodes(const Scene& scene, std::span<const std::string> namesOrNumbers, Pose& pose);

// The node that hideNodes means by the text.
int nodeCalled(const Scene& scene, const std::string& nameOrNumber);

// What a node is to be called; see hideNodes.
std::string callingOf(const Scene& scene, int node);

}  // namespace defocus::engine
