#pragma once
// Exports a mesh as a binary glTF 2.0 file (.glb) with one node, for inspection in other programs. The file contains
// positions, normals, texture coordinates and colours; primitives remain separate. Materials, skins and morph targets
// are not exported.
//
// Invalid data is repaired: triangles with non-finite positions, primitives without triangles, and unused vertices are
// dropped. Normals get unit length; zero or non-finite normals become +y.

#include <filesystem>

#include "scene/mesh.h"

namespace defocus::engine {

// Writes the file atomically. Throws Error if writing fails, no triangle remains, an index is out of range, or the file
// would exceed 4 GiB.
void writeGlb(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace defocus::engine
