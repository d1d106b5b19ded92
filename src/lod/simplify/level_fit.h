#pragma once
// Positions, normals and colours for a coarser level. The values that its vertices happen to have pick up single spots
// of a pattern and single bumps of a relief, and a level whose vertices all lie on a bulging surface is too small for
// it. Instead what the level interpolates linearly is fitted to all vertices of level 0, in the sense of least squares
// (as Hoppe et al. 1993, Mesh Optimization, fit positions; Jacobi-preconditioned conjugate gradients, Hestenes and
// Stiefel 1952).

#include <cstdint>
#include <span>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus {

// Where a vertex of level 0 lies on a coarser level: a point of one of its triangles, as a weighted mean of the
// corners. Weights of 0 leave the vertex out.
struct Anchor {
    std::uint32_t triangle = 0;
    float weight[3] = {0, 0, 0};
    float count = 1;  // of vertices that it stands for
};

// A level's triangles, with vertices numbered from 0.
struct LevelMesh {
    TriangleSet triangles;
    std::vector<std::uint32_t> sources;  // for each vertex, which one of the mesh's it has its values from
    // For each vertex; 1: it is on the other side of a thin sheet than the others at its place, and shares its normal
    // and colour only with those that are as well.
    std::vector<std::uint8_t> apart;
};

// The values of each vertex of a LevelMesh.
struct LevelFit {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   // of length ≤ 1: the shorter, the more the normals that it stands for differ
    std::vector<glm::u8vec4> colors;  // empty without colours
};

// What all levels of a mesh are fitted to. Vertices with equal numbers in `smoothing` share a normal (smoothingGroups),
// those with equal numbers in `shades` a colour; the number is that of one of them.
struct FitSource {
    const Vertices& vertices;
    const Welded& positions;
    std::span<const std::uint32_t> smoothing;
    std::vector<std::uint32_t> shades;  // empty without colours
    std::vector<float> areas;           // the share of level 0's surface that each vertex stands for, mean 1
    Bounds bounds;                      // of level 0's triangles
};

// Prepares the fit; `indices` are level 0's triangles. Keeps references to the other three.
FitSource prepareFit(const Vertices& vertices, const Welded& positions, std::span<const std::uint32_t> smoothing,
                     std::span<const std::uint32_t> indices);

// Fits a level. `anchors` holds one entry a vertex of the mesh, which counts by its area, foreshortened on its
// triangle; vertices that no anchor names keep the values they have from the mesh. The fit turns no triangle by more
// than 60° and leaves no part of them outside level 0's box. Vertices at one position stay at one; those whose normals
// agree within a degree share one normal, and with equal colours one colour, so that neither gap nor seam shows.
LevelFit fitLevel(const FitSource& source, const LevelMesh& level, std::vector<Anchor> anchors);

}  // namespace defocus
