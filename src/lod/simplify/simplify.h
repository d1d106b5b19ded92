#pragma once
// Makes a sequence of ever coarser meshes from a mesh by half-edge collapses with quadrics. Their vertices are among
// the mesh's.
//
// The surface is joined by position over all primitives, so that seams and material borders stay shut; see manifold.h
// for what becomes of surfaces that aren't manifold and wedges.h for the attributes. A collapse is
//   good:  nothing speaks against it;
//   poor:  it leaves a seam or an open border, or makes a sliver: it costs ten times as much;
//   bad:   it turns a face's normal by more than 75° or draws a vertex of another primitive: it is made only when no
//          other is left anywhere.
// The cost of a collapse is the quadric error of places (Garland and Heckbert 1997), with constraints along borders,
// seams and the rims of thin sheets, plus that of attributes (Hoppe 1999). The topology never changes (link condition):
// a closed surface is closed at every level, and a component ends as a tetrahedron or its like; one of many handles
// ends far above that. Where most faces are of components that good and poor collapses make no smaller, the others keep
// a part of their share by area, and no component makes bad ones below its share. Where collapses come no further,
// whole components go, the smallest first and never the largest; one near each grows in its place.

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

constexpr std::size_t fewestToGiveBack = 16'384;  // triangles of a mesh whose freed memory is worth giving back

struct SimplifyOptions {
    std::uint32_t minTriangles = 64;  // halving ends here
    int maxLevels = 23;               // without level 0
    bool anchors = true;              // whether levels get them; a level without anchors can't be fitted
    // Instead of halving: how much of the mesh's vertices each level keeps, shrinking; vertices at one position are
    // one.
    std::vector<double> vertexShares = {};
    // Gets the share of the triangles that are gone, [0, 1], again and again, on the thread of the call; may be empty.
    std::function<void(double)> lost = {};
};

struct Ball {
    glm::dvec3 centre{0};  // object units
    double radius = 0;
};

struct SimplifiedLevel {
    LevelMesh mesh;
    // For each vertex of `mesh`, its number in the mesh that is simplified, or vertexCount + i if it is twin i.
    Numbered<LevelVertexNumber, MeshVertexNumber> numbers;
    Numbered<MeshVertexNumber, Anchor> anchors;
    std::vector<Ball> removed;  // around each component that the level lacks
};

struct Simplification {
    // A twin is a second vertex beside twins[i] of the mesh, for the other side of a thin sheet whose rim has
    // collapsed.
    std::vector<MeshVertexNumber> twins;
    std::uint32_t levelCount = 0;  // coarser and coarser, the mesh itself not among them; may be 0
    std::uint32_t repairedFaces = 0;
    PyramidEnd end = PyramidEnd::maxLevels;
};

// Makes levels of half the triangles each, until less than a quarter can be saved, or levels of the given shares of the
// vertices. Calls take(l, level) once for each
// level l = 0 … levelCount − 1, on the thread of `tasks` that has made its anchors. The caller must call tasks.wait()
// to have them all, and must keep `smoothing` and `vertices` until then.
Simplification simplify(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                        const TriangleSet<MeshVertexNumber>& triangles, const SimplifyOptions& options, Tasks& tasks,
                        const std::function<void(std::uint32_t, SimplifiedLevel)>& take);

}  // namespace defocus::engine
