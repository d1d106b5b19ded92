#pragma once
// Holds what all levels of a mesh are fitted to: its vertices, what they share with each other, and what the levels
// keep of the whole surface.

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
    const VertexGroups& smoothing;                   // vertices of one group share a normal
    VertexGroups shades;                             // those of one group share a colour; empty without colours
    VertexGroups charts;                             // those of one group share texture coordinates; empty without
    Numbered<MeshVertexNumber, std::uint8_t> seams;  // 1: others at its position have other coordinates; empty without
    Numbered<MeshVertexNumber, float> areas;  // the share of level 0's surface that each vertex stands for, mean 1
    Bounds bounds;                            // of level 0's triangles
    // Level 0's values of what the levels keep (conserve.h).
    glm::dvec4 meanColor{0};
    std::vector<CoverGrid> outlines;
};

// Prepares the fit; `triangles` are level 0's. Keeps references to the other three.
FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles);

// Both sets of texture coordinates; a set that the vertices don't have is 0.
struct Coordinates {
    glm::vec2 uv0{0};
    glm::vec2 uv1{0};
};

Coordinates coordinatesOf(const Vertices& vertices, MeshVertexNumber v);

}  // namespace defocus
