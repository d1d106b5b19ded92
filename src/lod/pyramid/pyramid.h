#pragma once
// Defines the pyramid of a mesh: the mesh and its simplified levels. Level 0 is the mesh; each further level has about
// half the triangles of the previous level.
//
// All levels index one shared vertex buffer. It is sorted by the coarsest level that uses each vertex, so that level l
// uses the prefix [0, vertexCount[l]). Vertices at the same position are adjacent. Joints, weights, tangents and morph
// targets are copied from the surviving vertices of the mesh. Positions, normals, colours and texture coordinates are
// stored per level and fitted to level 0 (level_fit.h). With LevelVertices::surviving, they are copied from the
// surviving vertices, too. With LevelVertices::quarters, there are three levels, with 100 %, 75 % and 50 % of the
// vertices.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "defocus/settings.h"
#include "lod/simplify/pyramid_end.h"
#include "scene/mesh.h"

namespace defocus::engine {

class Finishes;

struct IndexRange {
    std::uint32_t first = 0;  // offset into Pyramid::indices
    std::uint32_t count = 0;  // number of indices, a multiple of 3
};

// A cluster is a run of triangles of one level that are close together and face similar directions. The renderer skips
// all of its triangles if no lens sample sees any (plan/visible/visibility.h). All lengths are in object units,
// measured at the level's own vertices. The bounds are rounded outwards, so that they hold for the exact planes of the
// triangles.
struct Cluster {
    IndexRange indices;       // range of indices within one primitive
    glm::vec3 centre{0};      // centre of a bounding sphere of the vertices
    float radius = 0;         // radius of the bounding sphere
    glm::vec3 axis{0, 0, 1};  // unit axis of a cone that contains the unit normals of all triangles
    float minCosine = -1;     // min cosine of the angle between the normal of a triangle and `axis`
    float planes = 0;         // min over the triangles of n·(p − centre): unit normal n, point p on the plane
    // Smallest altitude of any triangle. Triangles with coinciding corners are ignored, because they draw nothing.
    float minAltitude = 0;
};

inline constexpr std::uint32_t maxClusterTriangles = 64;

// Meshes with fewer triangles per primitive have only level 0, because the draw call of each primitive costs more time
// than coarser levels would save.
inline constexpr std::size_t minTrianglesPerPrimitive = 4;

// Number of entries of a BlurTable, which holds an error or a contrast of radiance (PyramidLevel::blurredError,
// Pyramid::contrast) for square patches of growing size. Entry 0: single points. Entry i ≥ 1: patches with side 2^(i −
// 1) · Pyramid::smallestPatch. Values are relative to the mean radiance of the mesh.
inline constexpr std::size_t blurSizes = 10;
using BlurTable = std::array<float, blurSizes>;

// Background on which the radiance of a mesh is measured. Outlines have a high contrast on black, and a low contrast on
// a grey of the mesh's mean radiance. A real background is between the two.
enum class Surround { black, grey };
inline constexpr std::array surrounds = {Surround::black, Surround::grey};
using BlurTables = std::array<BlurTable, surrounds.size()>;  // one table per background (Surround)

struct PyramidLevel {
    std::vector<IndexRange> primitives;  // one range per primitive of the mesh, in mesh order
    std::uint32_t vertexCount = 0;       // length of the vertex-buffer prefix that the level uses
    std::uint32_t triangleCount = 0;
    std::vector<Cluster> clusters;  // sorted by index range; together they contain all triangles of the level
    // Vertex attributes of the level, fitted to level 0. Level 0 and levels of LevelVertices::surviving have the mesh's
    // own attributes. Fitted positions lie inside the bounds of level 0. Vertices at the same position stay at the same
    // position. Fitted normals have length ≤ 1. A shorter normal represents normals of level 0 that diverge more; a
    // matt surface with such normals reflects less light.
    std::vector<glm::vec3> positions;  // vertexCount entries
    std::vector<glm::vec3> normals;    // vertexCount entries
    std::vector<glm::vec4> colors;     // vertexCount entries; values may lie outside [0, 1]; empty without colours
    std::vector<glm::vec2> uv0, uv1;   // vertexCount entries; empty without texture coordinates

    // Mean edge length over all faces, in object units; an edge counts once per face. Raised, if necessary, to 1.05
    // times the value of the previous level and to 2·error: a level with a large error is not finer than its error,
    // however short its edges are.
    double meanEdge = 0;
    double longestEdge = 0;  // length of the longest edge, object units

    // Distance between the surfaces of the level and of level 0, in object units: the larger of the two 99th
    // percentiles over the area, one per direction. The percentiles are estimated conservatively from 256 to 1,024
    // points per direction (surface_distance.h). With e[l] for the error of level l: e[0] = 0, and errors are raised
    // where needed so that e[l+1] ≥ 1.25·e[l] and e[1] ≥ 1e-6 of the bounding box's diagonal. If components were
    // removed from the level, the error is at least their size and at least the distance from any of their points to
    // the level. The error never exceeds the diagonal of the bounding box.
    double error = 0;

    BlurTables blurredError{};  // errors after blurring (blurred_error.h); 0 for level 0
};

struct Pyramid {
    // The vertices of level 0, sorted by the coarsest level that uses each vertex; identical vertices are merged.
    // `normals` are the normals of level 0. A few vertices are stored twice, for coarser levels that need two normals
    // at one position.
    Vertices vertices;
    std::vector<std::uint32_t> source;   // index of each vertex in Mesh::vertices, used for morph targets
    std::vector<std::uint32_t> indices;  // indices of all levels, level by level
    std::vector<PyramidLevel> levels;    // finest first, at least one; an empty mesh has one empty level
    Bounds bounds;                       // bounding box of level 0's triangles, in object units
    // For each joint, the bounding box of the vertices that it moves at any level, in object units; empty without
    // joints.
    std::vector<Bounds> jointBounds;
    // For each morph target, the bounding box of its displacements and of the origin, in object units.
    std::vector<Bounds> morphBounds;
    double smallestPatch = 0;  // side of the smallest patch of a BlurTable, object units; 0 if there is only level 0
    // Standard deviation V of level 0's radiance within patches of each size; see blurred_error.h.
    BlurTables contrast{};
    // Number of faces that were repaired to build a manifold for collapses (manifold.h); 0 if no collapse was
    // attempted.
    std::uint32_t repairedFaces = 0;
    PyramidEnd end = PyramidEnd::maxLevels;
};

struct PyramidOptions {
    // Min triangle count of simplified levels; the last collapse may remove one triangle more.
    std::uint32_t minTriangles = 64;
    int maxLevels = 24;  // max number of levels, including level 0
    LevelVertices vertices = LevelVertices::fitted;
    const Finishes* finishes = nullptr;  // materials of the scene that owns the meshes; null: white and matt
    std::uint64_t memoryLimit = 0;       // max memory of the process in bytes during the build; 0: no limit
};

const char* levelVerticesName(LevelVertices vertices);  // Returns the name used on the command line.

// Builds a mesh's pyramid of levels. Deterministic: equal meshes give bit-identical pyramids. Level 0 keeps every
// triangle of the mesh. The pyramid ends where a further level would save less than a quarter of the triangles. Throws
// Error if an index is out of range or the memory limit is too low (build_memory.h). `helpers` is the number of threads
// that fit and measure levels while the calling thread collapses edges. `step` receives the completed fraction of the
// work, in [0, 1], in steps of about 0.01; it is called on the calling thread.
Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options = {}, std::size_t helpers = 0,
                     const std::function<void(double)>& step = {});

// Returns the total number of triangles of the meshes.
std::uint64_t trianglesOf(std::span<const Mesh> meshes);

// Computes jointBounds and morphBounds from the pyramid's levels and its source mesh.
void measureDeformations(Pyramid& pyramid, const Mesh& mesh);

// Builds a pyramid with level 0 only, for renders without levels of detail. Vertex and index order are still optimised.
Pyramid fullDetail(const Mesh& mesh);

}  // namespace defocus::engine
