#pragma once
// Reads animation clips and skins. Internal to the glTF loader.

#include "scene/gltf/node.h"
#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Returns the file's animation clips. Channels of nodes that are not in `hierarchy` are dropped. Channels of
// unsupported properties are listed in Source::ignored.
std::vector<AnimationClip> readAnimations(Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes);

std::vector<Skin> readSkins(Source& source, const Hierarchy& hierarchy);

// Throws Error if a mesh has joint indices beyond the joints of its node's skin.
void checkSkinnedMeshes(const Source& source, const Hierarchy& hierarchy, const std::vector<Mesh>& meshes,
                        const std::vector<Skin>& skins);

}  // namespace defocus::engine::gltf
