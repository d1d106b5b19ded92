#pragma once
// Builds a fast preview of a mesh, which is drawn while the mesh's pyramid (its levels of detail) is built. The preview
// is made by meshoptimizer's simplifier. If this simplifier cannot reach the target, for example because triangles
// share no vertices, meshoptimizer's sloppy simplifier is used, which merges the vertices in each cell of a grid.
// Attributes are neither fitted nor measured.

#include <cstdint>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Builds a pyramid with one level of about `triangles` triangles, at most 1.5 times as many. The level's vertices are a
// subset of the mesh's vertices (see Pyramid::source), with their joints and morph targets. A mesh with fewer triangles
// is kept unchanged. A primitive that is smaller than a grid cell may disappear.
Pyramid draftPyramid(const Mesh& mesh, std::uint32_t triangles);

}  // namespace defocus::engine
