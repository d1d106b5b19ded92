#pragma once
// Animation clips and skins. Internal to the loader.

#include "scene/gltf/node.h"
#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Clips over the kept nodes. Channels of other nodes are dropped; those that cannot be played are noted.
std::vector<AnimationClip> readAnimations(Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes);

std::vector<Skin> readSkins(Source& source, const Hierarchy& hierarchy);

// Throws Error when a mesh names joints that its node's skin does not have.
void checkSkinnedMeshes(const Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes,
                        const std::vector<Skin>& skins);

}  // namespace defocus::engine::gltf
