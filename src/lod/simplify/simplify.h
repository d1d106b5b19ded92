#pragma once
// Simplifies a mesh into a sequence of coarser meshes by half-edge collapses with quadric error metrics. The vertices
// of the coarser meshes are a subset of the mesh's vertices.
//
// The surface is connected by position across all primitives, so that seams and material borders stay closed. See
// manifold.h for non-manifold surfaces and wedges.h for attributes. Each collapse belongs to one of these classes:
//   good:  neither poor nor bad;
//   poor:  it pulls the surface away from a seam or an open border, or makes a sliver; its cost is multiplied by ten;
//   bad:   it rotates a face's normal by more than 75° or assigns a vertex of another primitive to a face.
// A bad collapse is made only when no good or poor collapse is left in the mesh. The cost of a collapse is the sum of
// two quadric errors. The position error (Garland and Heckbert 1997) includes constraints along borders, seams and the
// rims of thin plates such as fins. The attribute error follows Hoppe 1999.
//
// The topology never changes (link condition). A closed surface is closed at every level. A component is a connected
// part of the mesh. A component without handles can shrink to a tetrahedron; a component with many handles keeps far
// more triangles.
//
// A component is spent when it has no good or poor collapse left. A component's even share of the faces is proportional
// to its area. Bad collapses never reduce a component below its even share. If spent components hold most of the faces,
// good and poor collapses end when the other components have only a fraction of their even share left. If collapses
// cannot reach the target, complete components are removed, the smallest first and never the largest. For each removed
// component, a nearby one is enlarged to make up for the lost area.

#include <cstdint>
#include <functional>
#include <vector>

#include "core/parallel.h"
#include "lod/simplify/level_fit.h"
#include "lod/simplify/pyramid_end.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Min triangle count of meshes for which freed memory is returned to the operating system.
constexpr std::size_t fewestToGiveBack = 16'384;

struct SimplifyOptions {
    std::uint32_t minTriangles = 64;  // halving ends at about this number of triangles
    int maxLevels = 23;               // max number of levels, excluding level 0
    // true: computes the anchors of each level (points that represent the mesh's vertices). Levels without anchors
    // cannot be fitted (level_fit.h).
    bool anchors = true;
    // If not empty, levels are not made by halving the triangles: each entry is the fraction of the mesh's vertex
    // positions that one level keeps, in decreasing order. Vertices at the same position count once.
    std::vector<double> vertexShares = {};
    // Called repeatedly on the calling thread of simplify() with the fraction of the triangles removed so far, in [0,
    // 1]. May be empty.
    std::function<void(double)> lost = {};
};

struct Ball {
    glm::dvec3 centre{0};  // object units
    double radius = 0;
};

struct SimplifiedLevel {
    LevelMesh mesh;
    // For each vertex of `mesh`, its number in the original mesh. vertexCount + i is the number of copy i
    // (Simplification::twins).
    Numbered<LevelVertexNumber, MeshVertexNumber> numbers;
    Numbered<MeshVertexNumber, Anchor> anchors;
    std::vector<Ball> removed;  // bounding sphere of each component that was removed from the level
};

struct Simplification {
    // Copies of vertices: twin i is a copy of mesh vertex twins[i]. It is used on the other side of a thin plate, such
    // as a fin, whose rim has collapsed.
    std::vector<MeshVertexNumber> twins;
    std::uint32_t levelCount = 0;  // number of simplified levels, excluding the mesh itself; may be 0
    std::uint32_t repairedFaces = 0;
    PyramidEnd end = PyramidEnd::maxLevels;
};

// Makes levels that each have half the triangles of the previous level, and ends where the next level would save less
// than a quarter of the triangles. If `options.vertexShares` is not empty, it gives instead the fraction of the mesh's
// vertex positions that each level keeps. Calls take(l, level) once for each level l = 0 … levelCount − 1, on the
// thread of `tasks` that computed the level's anchors (points that represent the mesh's vertices). The last calls may
// come after simplify() returns: the caller must call tasks.wait(). Until then, `smoothing` and `vertices` must stay
// alive.
Simplification simplify(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                        const TriangleSet<MeshVertexNumber>& triangles, const SimplifyOptions& options, Tasks& tasks,
                        const std::function<void(std::uint32_t, SimplifiedLevel)>& take);

}  // namespace defocus::engine
