#pragma once
// What a wide blur shows of a surface, and what a fitted level keeps of it.

#include <glm/vec4.hpp>
#include <vector>

#include "lod/simplify/level_fit.h"

namespace defocus {

// Corrects a fitted level until it keeps what a wide blur would show of level 0:
// - the area that it covers, where it is so coarse that it may lose any: what lies at its outlines moves (outline.h);
// - the mean colour over its area, alpha included: all colours are shifted alike.
// What fitLevel promises of places and of normals that are shared still holds; a triangle turns by at most 60° more.
void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit);

// The means of the colours over a level's area, and those of what its anchors stand for in level 0: of each patch of
// the level's triangles, which are numbered from 0. A patch that no anchor names has an area of 0 there.
struct PatchMeans {
    std::vector<double> areas, areas0;  // the second in means of all vertices' areas
    std::vector<glm::dvec4> colors, colors0;
};
PatchMeans patchMeans(const FitSource& source, const LevelMesh& level, const LevelFit& fit,
                      const Numbered<MeshVertexNumber, Anchor>& anchors,
                      const Numbered<TriangleNumber, std::uint32_t>& patchOf);

}  // namespace defocus
