#pragma once
// Any set of triangles as an oriented manifold with boundary, which is what half-edges can hold: every edge has at most
// one face on either side and the faces around a vertex form a single fan.
//
// Nothing is dropped but what has no place in any surface: degenerate faces (two corners at one position) and exact
// repetitions of a face of the same primitive. Faces wound against their neighbours are turned (and say so). An edge of
// more than two faces keeps the pairs that continue each other best and is cut open between the others; a vertex where
// several fans meet becomes one vertex a fan.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/simplify/repairs.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"

namespace defocus {

struct Manifold {
    static constexpr std::uint32_t none = 0xffffffffu;

    std::vector<std::uint32_t> faces;    // the input face of each face
    std::vector<std::uint32_t> corners;  // the vertices of each face, three a face, in the input face's corner order
    std::vector<std::uint8_t> turned;    // 1: the surface's orientation runs against the corner order
    // Half-edge 3·f + i runs from corner i to i + 1: the one on its other side, or none.
    std::vector<std::uint32_t> twins;
    std::vector<std::uint32_t> positions;  // the welded position of each vertex
    Repairs repairs;
};

// The triangles by the welded positions of their corners; `points` are those positions. A triangle with a corner that
// is no place at all becomes degenerate.
TriangleSet weldedTriangles(const TriangleSet& triangles, const Welded& positions,
                            const std::vector<glm::dvec3>& points);

// `triangles` are by welded positions: equal numbers, equal positions; `points` are these.
Manifold buildManifold(const TriangleSet& triangles, const std::vector<glm::dvec3>& points);

}  // namespace defocus
