#pragma once
// What all levels of a mesh are fitted to: its vertices, what they share with each other, and what of the whole surface
// the levels keep.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/outline.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus {

struct FitSource {
    const Vertices& vertices;
    const WeldedPositions& positions;
    const VertexGroups& smoothing;                   // vertices of one share a normal
    VertexGroups shades;                             // vertices of one share a colour; empty without colours
    VertexGroups charts;                             // and here texture coordinates; empty without
    Numbered<MeshVertexNumber, std::uint8_t> seams;  // 1: others at its position have other ones; empty without
    Numbered<MeshVertexNumber, float> areas;  // the share of level 0's surface that each vertex stands for, mean 1
    Bounds bounds;                            // of level 0's triangles
    // What level 0 has of what levels keep (conserve.h).
    glm::dvec4 meanColor{0};
    std::vector<CoverGrid> outlines;
};

// Prepares the fit; `triangles` are level 0's. Keeps references to the other three.
FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles);

// Texture coordinates, both sets; 0 of what the vertices don't have.
struct Coordinates {
    glm::vec2 uv0{0};
    glm::vec2 uv1{0};
};

Coordinates coordinatesOf(const Vertices& vertices, MeshVertexNumber v);

}  // namespace defocus
