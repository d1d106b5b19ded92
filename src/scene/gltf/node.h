#pragma once
// The hierarchy of the chosen scene: nodes, instances, cameras and lights. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// The nodes that are kept: those of the file's default scene (else its first, else all), and what skins need of others.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<int> roots;
    std::vector<int> kept;  // glTF node → index into nodes, or -1
    std::string sceneName;
};

// Throws Error for loops, nodes with two parents, and instances of unequal counts.
Hierarchy readHierarchy(Source& source);

std::vector<Camera> readCameras(Source& source);
std::vector<Light> readLights(Source& source);

}  // namespace defocus::engine::gltf
