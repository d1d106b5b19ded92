#pragma once
// Positions, normals and colours for a coarser level. The values that its vertices happen to have pick up single spots
// of a pattern and single bumps of a relief, and a level whose vertices all lie on a bulging surface is too small for
// it. Instead what the level interpolates linearly is fitted to all vertices of level 0, in the sense of least squares
// (as Hoppe et al. 1993, Mesh Optimization, fit positions; Jacobi-preconditioned conjugate gradients, Hestenes and
// Stiefel 1952).

#include <cstdint>
#include <span>
#include <vector>

#include "lod/weld.h"
#include "scene/mesh.h"

namespace defocus {

// Where a vertex of level 0 lies on a coarser level: the closest point of one of its triangles, as a weighted mean of
// three of the level's vertices. Weights of 0 leave the vertex out.
struct Anchor {
    std::uint32_t vertex[3] = {0, 0, 0};
    float weight[3] = {0, 0, 0};
};

struct LevelFit {
    std::vector<glm::vec3> positions;  // one a vertex
    std::vector<glm::vec3>
        normals;  // one a vertex; of length ≤ 1: the shorter, the more the normals that it stands for differ
    std::vector<glm::u8vec4> colors;  // one a vertex; empty without colours
};

// What all levels of a mesh are fitted to.
struct FitSource {
    const Vertices& vertices;              // the mesh's, then the twins (see simplify.h)
    const Welded& positions;               // of them
    std::vector<std::uint32_t> smoothing;  // groups that share a normal; twins stand apart
    std::vector<float> areas;              // the share of level 0's surface that each vertex stands for, mean 1
    Bounds bounds;                         // of level 0's triangles
};

// `ownCount` of the vertices are the mesh's; `indices` are level 0's triangles. Keeps references to both.
FitSource prepareFit(const Vertices& vertices, const Welded& positions, std::size_t ownCount,
                     std::span<const std::uint32_t> indices);

// `anchors` holds one entry a vertex of the mesh, which counts by its area, foreshortened on its face; values of
// vertices that no anchor names stay their own. `indices` are the level's triangles: the fit turns none of them by more
// than 60° and leaves no part of them outside level 0's box. Vertices at one position stay at one; those whose normals
// agree within a degree share one normal, and with equal colours one colour, so that neither gap nor seam shows.
LevelFit fitLevel(const FitSource& source, std::span<const Anchor> anchors, std::span<const std::uint32_t> indices);

}  // namespace defocus
