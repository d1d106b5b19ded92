#pragma once
// Reads glTF meshes: all triangle primitives of a mesh share one vertex array. Internal to the glTF loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Returns one Mesh per glTF mesh. Primitives with the same attributes share vertices, and unused vertices are dropped.
// Strips and fans become triangle lists; points and lines become Mesh::strokes. Primitives without normals are
// flat-shaded with unshared vertices, as glTF requires. Primitives with a normal map but without tangents get tangents.
std::vector<Mesh> readMeshes(Source& source, const std::vector<Material>& materials, const Progress& progress);

}  // namespace defocus::engine::gltf
