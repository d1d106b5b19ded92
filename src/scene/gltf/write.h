#pragma once
// Exports a mesh as a binary glTF 2.0 file (.glb) with one node, for inspection in other programs. The file has
// positions, normals, texture coordinates, colours, and one primitive per primitive of the mesh. Materials, skins and
// morph targets are not exported.
//
// Invalid data is repaired. Triangles with non-finite corners, primitives without triangles, and unused vertices are
// dropped. Normals get unit length, or +y if they are zero or non-finite.

#include <filesystem>

#include "scene/mesh.h"

namespace defocus::engine {

// Writes the file atomically. Throws Error with the path if writing fails. Throws Error with the mesh's name if no
// triangle is left, an index is out of range, or the file would exceed 4 GiB.
void writeGlb(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace defocus::engine
