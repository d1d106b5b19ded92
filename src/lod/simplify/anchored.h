#pragma once
// Computes what the anchors of a level's fit stand for, and how much of it counts.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "lod/simplify/level_fit.h"

namespace defocus {

// Returns whether the anchor leaves its vertex out of the fit.
bool isUnused(const Anchor& anchor);

// The vertices that an anchor stands for: its own, and those that share it.
struct Anchored {
    float area = 0;
    glm::vec3 normal{0};  // the mean over the area
    glm::vec4 color{0};   // the same; 0 without colours
};

// Returns a value for each vertex. It means nothing for a vertex without an anchor of its own.
Numbered<MeshVertexNumber, Anchored> anchoredValues(const FitSource& source,
                                                    const Numbered<MeshVertexNumber, Anchor>& anchors);

// Returns the unit normals of a level's triangles, with their corners at `positions`, which are those of level 0's
// vertices. A triangle without area gets zero.
Numbered<TriangleNumber, glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level);

// Returns how much of `area` counts: what its projection onto the anchor's triangle covers, but at least a fiftieth.
// `normal` is the normal of the area and `face` the unit normal of the triangle. All of it counts if the anchor lies at
// a corner or the triangle has no area.
float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal);

}  // namespace defocus
