#pragma once
// Hierarchy of the chosen scene: nodes, instances, cameras and lights. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Kept nodes: those of the default scene, else of the first scene, else all. Joints outside that scene and their
// ancestors are kept too.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<int> roots;
    std::vector<int> kept;  // maps glTF nodes to indices into `nodes`, or -1
    std::string sceneName;
};

// Throws Error for cycles, for nodes with two parents, and if instance attributes differ in count.
Hierarchy readHierarchy(Source& source);

std::vector<Camera> readCameras(Source& source);
std::vector<Light> readLights(Source& source);

}  // namespace defocus::engine::gltf
