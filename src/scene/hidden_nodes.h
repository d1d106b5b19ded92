#pragma once
// Hides nodes: objects of hidden nodes and of their descendants are not drawn.

#include <span>
#include <string>

#include "scene/pose.h"

namespace defocus::engine {

// Removes the objects of the given nodes and of their descendants from the pose; cameras and lights remain. Non-empty
// Pose::bounds are recomputed. A node is given by its name or, if the name is empty or ambiguous, by its index in
// Scene::nodes ("7" or "#7"). Throws Error for unknown names.
void hideNodes(const Scene& scene, std::span<const std::string> namesOrNumbers, Pose& pose);

// Returns the index of the node with this name or index; see hideNodes for the syntax.
int nodeCalled(const Scene& scene, const std::string& nameOrNumber);

// Returns the text that identifies this node for nodeCalled: the node's name if it is unique, else its index.
std::string callingOf(const Scene& scene, int node);

}  // namespace defocus::engine
