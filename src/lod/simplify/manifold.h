#pragma once
// Makes an oriented manifold with boundary of any set of triangles, because half-edges can hold nothing else: every
// edge has at most one face on either side, and the faces around a vertex form a single fan.
//
// Only what has no place in any surface is dropped: degenerate faces (two corners at one position) and exact
// repetitions of a face of the same primitive. Faces wound against their neighbours are turned (and say so). An edge of
// more than two faces keeps the pairs that continue each other best and is cut open between the others; a vertex where
// several fans meet becomes one vertex a fan.

#include <cstdint>
#include <glm/vec3.hpp>

#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Counts the faces that have no place in a manifold as they are. A face may count as several kinds. Such faces are
// drawn unchanged at level 0; coarser levels are made of the repaired surface.
struct Repairs {
    std::uint32_t faces = 0;    // in all
    std::uint32_t dropped = 0;  // degenerate, or repetitions
    std::uint32_t turned = 0;   // wound against their neighbours
    std::uint32_t cut = 0;      // cut off at an edge of more than two faces, or of two that can't agree
    std::uint32_t split = 0;    // split off at a vertex where several fans meet
};

// Half-edges have the numbers of the corners that they leave, in the order that the input has a face's corners.
using SurfaceCorner = CornerNumber<SurfaceFaceNumber>;

struct Manifold {
    Numbered<SurfaceFaceNumber, TriangleNumber> faces;  // the input triangle of each face
    Numbered<SurfaceCorner, SurfaceVertexNumber> corners;
    Numbered<SurfaceFaceNumber, std::uint8_t> turned;  // 1: the surface's orientation runs against the corner order
    Numbered<SurfaceCorner, SurfaceCorner> twins;      // the half-edge on each one's other side, or none
    Numbered<SurfaceVertexNumber, PositionNumber> positions;
    Repairs repairs;
};

// Returns the triangles with the welded positions of their corners; `points` are those positions. A triangle with a
// corner that isn't finite becomes degenerate.
TriangleSet<PositionNumber> weldedTriangles(const TriangleSet<MeshVertexNumber>& triangles,
                                            const WeldedPositions& positions,
                                            const Numbered<PositionNumber, glm::dvec3>& points);

// `points` are the positions of the triangles' corners.
Manifold buildManifold(const TriangleSet<PositionNumber>& triangles,
                       const Numbered<PositionNumber, glm::dvec3>& points);

// Counts what buildManifold would repair of the mesh.
Repairs repairsOf(const Mesh& mesh);

}  // namespace defocus::engine
