#pragma once
// Pyramid: a mesh and its simplifications, each level about half the triangles of the one before (level 0 is the mesh
// itself).
//
// All levels index ONE vertex buffer whose vertices are sorted by how long they survive (vertices at one position stay
// together), so level l uses the prefix [0, vertexCount[l]). Only normals may differ between levels: level l has its
// own, re-averaged for its triangles.

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "scene/mesh.h"

namespace defocus {

struct IndexRange {
    std::uint32_t first = 0;  // into Pyramid::indices
    std::uint32_t count = 0;  // a multiple of 3
};

struct PyramidLevel {
    std::vector<IndexRange> primitives;  // one a primitive of the mesh, in its order
    std::uint32_t vertexCount = 0;       // the prefix of the vertex buffer that the level uses
    std::uint32_t triangleCount = 0;
    std::vector<glm::vec3> normals;  // vertexCount unit normals
    double meanEdge = 0;             // mean of all faces' edge lengths, object units; grows by 5 % a level or more
    double error = 0;  // distance to level 0, object units; e[0] = 0, e[l+1] ≥ 1.25·e[l] and above a floor
};

struct Pyramid {
    Vertices vertices;                   // of level 0, sorted by survival, equal ones joined; `normals` are level 0's
    std::vector<std::uint32_t> source;   // for each vertex, which one of Mesh::vertices it is (morph targets follow it)
    std::vector<std::uint32_t> indices;  // of all levels
    std::vector<PyramidLevel> levels;    // at least one; an empty mesh has one empty level
    Bounds bounds;                       // object units; of level 0's triangles
    std::uint32_t repairedFaces = 0;     // faces that half-edges can't hold as they are; see manifold.h
};

struct PyramidOptions {
    std::uint32_t leastTriangles = 64;  // halving ends here (the last collapse may take one triangle more)
    int mostLevels = 24;                // level 0 included
};

// Deterministic: same mesh, same pyramid, bit for bit. Level 0 keeps every triangle of the mesh. Levels end where a
// further one would save less than a quarter of the triangles. Throws Error for an index beyond the vertices.
Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options = {});

// One pyramid a mesh, built on all cores.
std::vector<Pyramid> buildPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options = {},
                                   const Progress& progress = {});

// Only level 0, for renders that use no other (nothing is simplified; vertex and index order are optimised all the
// same).
Pyramid fullDetail(const Mesh& mesh);

}  // namespace defocus
