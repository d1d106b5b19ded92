#pragma once
// Nodes that the user has hidden: their objects are not drawn.

#include <span>
#include <string>

#include "scene/pose.h"

namespace defocus::engine {

// Removes the objects of these nodes and of their descendants from the pose; cameras and lights stay. Non-empty bounds
// are updated for the remaining objects. A node is given by its name, or by its index in Scene::nodes ("7" or "#7") if
// the name is empty or ambiguous. Throws Error for unknown names.
void hideNodes(const Scene& scene, std::span<const std::string> namesOrNumbers, Pose& pose);

// Returns the index of the node that the text names; see hideNodes for the syntax.
int nodeCalled(const Scene& scene, const std::string& nameOrNumber);

// Returns a text that nodeCalled resolves to this node: its name if unique, else its index.
std::string callingOf(const Scene& scene, int node);

}  // namespace defocus::engine
