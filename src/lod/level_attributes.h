#pragma once
// Colours and normals for a coarser level. The values that its vertices happen to have pick up single spots of a
// pattern and single bumps of a relief; instead the level's linearly interpolated attributes are fitted to those of all
// vertices of level 0, in the sense of least squares (Jacobi-preconditioned conjugate gradients; Hestenes and Stiefel
// 1952).

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh.h"

namespace defocus {

// Where a vertex of level 0 lies on a coarser level: the closest point of one of its triangles, as a weighted mean of
// three of the level's vertices. Weights of 0 leave the vertex out.
struct Anchor {
    std::uint32_t vertex[3] = {0, 0, 0};
    float weight[3] = {0, 0, 0};
};

struct LevelAttributes {
    std::vector<glm::vec3>
        normals;  // one a vertex; of length ≤ 1: the shorter, the more the normals that it stands for differ
    std::vector<glm::u8vec4> colors;  // one a vertex; empty without colours
};

// `anchors` holds one entry a vertex of `vertices`; values of vertices that no anchor names stay their own. Vertices at
// one position
// (`positions` numbers equal positions alike) whose normals agree within a degree share one normal, and with equal
// colours one colour, so that no seam shows.
LevelAttributes fitAttributes(const Vertices& vertices, const std::vector<std::uint32_t>& positions,
                              std::span<const Anchor> anchors);

}  // namespace defocus
