#pragma once
// Animation clips and skins. Internal to the loader.

#include "scene/gltf/node.h"
#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Returns the clips of the kept nodes. Channels of other nodes are dropped; channels that cannot be played are noted.
std::vector<AnimationClip> readAnimations(Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes);

std::vector<Skin> readSkins(Source& source, const Hierarchy& hierarchy);

// Throws Error if a mesh refers to joints that its node's skin lacks.
void checkSkinnedMeshes(const Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes,
                        const std::vector<Skin>& skins);

}  // namespace defocus::engine::gltf
