#pragma once
// A mesh as a binary glTF 2.0 file (.glb) of its own, for other programs to look at: its triangles with positions,
// normals, texture coordinates and colours, one primitive a primitive of the mesh, on one node. Materials, skins and
// morph targets are not written.
//
// What the standard forbids is mended: triangles with a corner that isn't finite are left out, as are primitives
// without triangles and vertices that no triangle uses; normals get unit length (+y where they have none).

#include <filesystem>

#include "scene/mesh.h"

namespace defocus::engine {

// Writes the file, all or nothing. Throws Error with the path, or with the mesh's name when no triangle is left to
// write, an index is beyond the vertices, or the file would be larger than the format holds (4 GiB).
void writeGlb(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace defocus::engine
