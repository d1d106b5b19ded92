#pragma once
// Converts any set of triangles to an oriented manifold with boundary, because half-edges can represent no other
// surface. Every edge has at most one face on each side. The faces around a vertex form a single fan.
//
// Only two kinds of faces are removed. Degenerate faces have two corners at the same position. Duplicates repeat a face
// of the same primitive exactly. Faces with a winding opposite to their neighbours are reversed. At an edge with more
// than two faces, the best-matching pairs of faces stay connected; the edge is cut between these pairs. A vertex where
// several fans of faces meet is split into one vertex per fan.

#include <cstdint>
#include <glm/vec3.hpp>

#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Counts of repaired faces, in total and per kind of repair. A face may count in several kinds. Level 0 draws these
// faces unchanged; coarser levels are made from the repaired surface.
struct Repairs {
    std::uint32_t faces = 0;    // total number of repaired faces
    std::uint32_t dropped = 0;  // degenerate or duplicate faces; the only faces that are removed
    std::uint32_t turned = 0;   // faces reversed because their winding was opposite to their neighbours
    std::uint32_t cut = 0;      // faces cut off at an edge of three or more faces, or of two faces of opposite winding
    std::uint32_t split = 0;    // faces that use a new copy of a vertex where several fans of faces meet
};

// Number of a half-edge: the number of the face corner where it starts. Corners are numbered in input order.
using SurfaceCorner = CornerNumber<SurfaceFaceNumber>;

struct Manifold {
    Numbered<SurfaceFaceNumber, TriangleNumber> faces;  // the input triangle of each face
    Numbered<SurfaceCorner, SurfaceVertexNumber> corners;
    Numbered<SurfaceFaceNumber, std::uint8_t> turned;  // 1: the face is reversed relative to its input triangle
    Numbered<SurfaceCorner, SurfaceCorner> twins;      // opposite half-edge of each half-edge; invalid if there is none
    Numbered<SurfaceVertexNumber, PositionNumber> positions;
    Repairs repairs;
};

// Returns the triangles, with indices of welded positions at their corners. `points` are the coordinates of the welded
// positions. A triangle with a NaN or infinite corner becomes degenerate.
TriangleSet<PositionNumber> weldedTriangles(const TriangleSet<MeshVertexNumber>& triangles,
                                            const WeldedPositions& positions,
                                            const Numbered<PositionNumber, glm::dvec3>& points);

// Builds the manifold. `points` are the coordinates of the numbered positions.
Manifold buildManifold(const TriangleSet<PositionNumber>& triangles,
                       const Numbered<PositionNumber, glm::dvec3>& points);

// Counts the faces of the mesh that buildManifold would repair.
Repairs repairsOf(const Mesh& mesh);

}  // namespace defocus::engine
