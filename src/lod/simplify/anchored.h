#pragma once
// What the anchors of a level's fit stand for, and how much of it counts.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "lod/simplify/level_fit.h"

namespace defocus {

// Whether the anchor leaves its vertex out.
bool isUnused(const Anchor& anchor);

// What an anchor stands for: its own vertex, and those that share it.
struct Anchored {
    float area = 0;
    glm::vec3 normal{0};  // the mean over the area
    glm::vec4 color{0};   // the same; 0 without colours
};

// Of each vertex; of those without an anchor of their own they mean nothing.
Numbered<MeshVertexNumber, Anchored> anchoredValues(const FitSource& source,
                                                    const Numbered<MeshVertexNumber, Anchor>& anchors);

// The normals of a level's triangles with their corners at `positions`, those of level 0's vertices. Unit length; zero
// of a triangle without area.
Numbered<TriangleNumber, glm::vec3> unitNormals(const std::vector<glm::vec3>& positions, const LevelMesh& level);

// How much of its triangle, whose unit normal is `face`, an area with this normal stands for, seen straight on.
float foreshortened(float area, const Anchor& anchor, const glm::vec3& face, const glm::vec3& normal);

}  // namespace defocus
