#pragma once
// Pyramid: a mesh and its simplifications, each level about half the triangles of the one before (level 0 is the mesh).
//
// All levels index ONE vertex buffer whose vertices are sorted by how long they survive (vertices at one position stay
// together), so level l uses the prefix [0, vertexCount[l]): joints, weights, tangents and morph targets are those of
// the surviving vertices. Positions, normals, colours and texture coordinates are each level's own, fitted to level 0
// (level_fit.h), or with LevelVertices::surviving those of the surviving vertices, too. With LevelVertices::quarters
// there are three levels, of all, three quarters and half of the vertices.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "defocus/settings.h"
#include "lod/simplify/pyramid_end.h"
#include "scene/mesh.h"

namespace defocus::engine {

class Finishes;

struct IndexRange {
    std::uint32_t first = 0;  // into Pyramid::indices
    std::uint32_t count = 0;  // a multiple of 3
};

// A cluster is a run of a level's triangles that lie near each other and face about the same way, so that a frame can
// leave out a whole run at once when no lens sample shows any of it (plan/visibility.h).
// Object units, as the level has its vertices. Rounded so that all of it holds for the triangles' exact planes.
struct Cluster {
    IndexRange indices;       // within one primitive
    glm::vec3 centre{0};      // of a ball around the vertices
    float radius = 0;         // of the ball
    glm::vec3 axis{0, 0, 1};  // unit length, about which the triangles' unit normals n lie
    float minCosine = -1;     // of the angle between an n and the axis
    float planes = 0;         // n·(p − centre) is at least this, p on the plane of n's triangle
    float minAltitude = 0;    // of the triangles; those of which corners coincide draw nothing and don't count
};

inline constexpr std::uint32_t maxClusterTriangles = 64;

// What a blur leaves of a difference: its root mean square once it is averaged over patches of growing size.
// [0]: over no patch, point by point. [i], i ≥ 1: over square patches of side 2^(i − 1) · Pyramid::smallestPatch. Light
// is in units of the mesh's own mean, so that 1 is all of it.
inline constexpr std::size_t blurSizes = 10;
using BlurTable = std::array<float, blurSizes>;

struct PyramidLevel {
    std::vector<IndexRange> primitives;  // one a primitive of the mesh, in its order
    std::uint32_t vertexCount = 0;       // the prefix of the vertex buffer that the level uses
    std::uint32_t triangleCount = 0;
    std::vector<Cluster> clusters;  // their ranges follow each other over those of the primitives
    // These are fitted to level 0 (there, and of vertices that survive: the mesh's own) and lie inside its bounds;
    // vertices at one position stay at one. Fitted normals have a length of at most 1: the shorter one is, the more the
    // normals that it stands for differ, and the less light a matt surface throws back.
    std::vector<glm::vec3> positions;  // vertexCount
    std::vector<glm::vec3> normals;    // vertexCount
    std::vector<glm::vec4> colors;     // vertexCount; empty without colours. A fitted one may lie outside [0, 1].
    std::vector<glm::vec2> uv0, uv1;   // vertexCount; empty without texture coordinates

    // Object units. The mean of all faces' edge lengths (an edge counts once a face), raised where needed so that it
    // grows by 5 % a level or more and is at least 2·error: a level isn't as fine as its edges where its error outgrew
    // them.
    double meanEdge = 0;
    double longestEdge = 0;  // object units

    // Object units. The distance between the level's surface and level 0's (99th percentile over the area, whichever
    // way it is larger), estimated on the safe side from 256 to 1,024 points each, and raised where needed so that
    // e[l+1] ≥ 1.25·e[l] and e[1] ≥ 1e-6 of the bounding box's diagonal; e[0] = 0. See surface_distance.h. If the level
    // lacks whole parts, the error is at least as large as they are and as far as any of their points is from the level
    // (up to the box's diagonal).
    double error = 0;

    BlurTable blurredError{};  // see blurred_error.h; 0 of level 0
};

struct Pyramid {
    // The vertices of level 0, sorted by survival, with equal ones joined; `normals` are level 0's. A few are there
    // twice, for coarser levels that need two normals at one place.
    Vertices vertices;
    std::vector<std::uint32_t> source;   // for each vertex, which one of Mesh::vertices it is (morph targets follow it)
    std::vector<std::uint32_t> indices;  // of all levels
    std::vector<PyramidLevel> levels;    // at least one; an empty mesh has one empty level
    Bounds bounds;                       // object units; of level 0's triangles
    std::vector<Bounds> jointBounds;     // object units; of what each joint moves, at any level; empty without joints
    std::vector<Bounds> morphBounds;     // object units; of each morph target's displacements and 0
    double smallestPatch = 0;            // object units; of blur tables, 0 without a second level
    BlurTable contrast{};  // of level 0: the standard deviation of its light within patches; see blurred_error.h
    std::uint32_t repairedFaces = 0;  // faces that half-edges can't hold as they are; see manifold.h
    PyramidEnd end = PyramidEnd::maxLevels;
};

struct PyramidOptions {
    std::uint32_t minTriangles = 64;  // halving ends here (the last collapse may take one triangle more)
    int maxLevels = 24;               // level 0 included
    LevelVertices vertices = LevelVertices::fitted;
    const Finishes* finishes = nullptr;  // of the scene that the meshes belong to; null: white and matt
};

const char* levelVerticesName(LevelVertices vertices);  // as the command line has it

// Builds a mesh's pyramid. Deterministic: same mesh, same pyramid, bit for bit. Level 0 keeps every triangle of the
// mesh. Levels end where a further one would save less than a quarter of the triangles. Throws Error for an index
// beyond the vertices. `helpers`: threads that fit and measure levels while the caller's goes on collapsing. `step`
// gets the share of the work that is done, [0, 1], in steps of a hundredth or so, on the caller's thread.
Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options = {}, std::size_t helpers = 0,
                     const std::function<void(double)>& step = {});

// Sums up how far several pyramids are, by their triangles, and reports it; from any thread.
class PyramidProgress {
public:
    // Both must outlive it.
    PyramidProgress(const std::vector<Mesh>& meshes, const Progress& progress);
    // Of mesh `mesh` this share is done, [0, 1].
    void reached(std::size_t mesh, double share);

private:
    const std::vector<Mesh>& meshes_;
    const Progress& progress_;
    std::mutex mutex_;
    std::vector<double> shares_;
    std::size_t finished_ = 0;
    double total_ = 0;    // triangles, and one a mesh
    double reached_ = 0;  // of these
};

// Returns how many triangles the meshes have together.
std::uint64_t trianglesOf(std::span<const Mesh> meshes);

// Returns how many helpers a mesh gets if it is built at once with others that have `all` triangles together: its share
// of the cores.
std::size_t pyramidHelpers(const Mesh& mesh, std::uint64_t all);

// Builds one pyramid a mesh, on all cores.
std::vector<Pyramid> buildPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options = {},
                                   const Progress& progress = {});

// Fills jointBounds and morphBounds from the rest of the pyramid and the mesh that it was made from.
void measureDeformations(Pyramid& pyramid, const Mesh& mesh);

// Builds level 0 alone, for renders that use no other; vertex and index order are optimised all the same.
Pyramid fullDetail(const Mesh& mesh);

}  // namespace defocus::engine
