#pragma once
// Reads the hierarchy of the chosen glTF scene: nodes, instances, cameras and lights. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Nodes that are kept: those of the file's default scene, else of its first scene, else all nodes. Joints outside the
// scene, and their ancestors, are also kept.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<int> roots;
    std::vector<int> kept;  // for each node of the file: its index in `nodes`; −1 if it is not kept
    std::string sceneName;
};

// Reads the nodes that are kept (see Hierarchy). Throws Error for cycles, for nodes with two parents, and for a node
// whose instance attributes differ in count.
Hierarchy readHierarchy(Source& source);

std::vector<Camera> readCameras(Source& source);
std::vector<Light> readLights(Source& source);

}  // namespace defocus::engine::gltf
