#pragma once
// glTF meshes → Mesh: all triangle primitives of a mesh over one set of vertices. Internal to the loader.

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// As many meshes as the file has. Primitives that name the same attributes share vertices; vertices that no triangle
// uses are dropped; strips and fans become lists; points and lines are ignored (and noted). Without normals a primitive
// is shaded flat, as the standard says, on vertices of its own. Tangents are made where a normal map needs them.
std::vector<Mesh> readMeshes(Source& source, const std::vector<Material>& materials, const Progress& progress);

}  // namespace defocus::engine::gltf
