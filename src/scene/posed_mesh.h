#pragma once
// Poses vertices on the CPU: applies morph targets, then the skin or the object's matrix (glTF 2.0, 3.7.2.2 and 3.7.3).
// The renderer's GPU code performs the same computation and is tested against this code.

#include <glm/vec3.hpp>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

// Returns the world-space position in m of each vertex: p' = Σ w_j · M_j · (p + Σ m_t · d_t) / Σ w_j for the mesh
// position p, with joint weights w_j and matrices M_j, and morph weights m_t and displacements d_t. Weights that are
// negative, NaN or infinite count as 0. Invalid joint indices, and vertices without weights, use the skin's first
// joint.
std::vector<glm::dvec3> posedPositions(const Mesh& mesh, const Object& object);

// Returns the vertex normals in world space; empty if the mesh has no normals. Each morphed normal is transformed by
// the inverse transpose of its vertex's matrix Σ w_j · M_j / Σ w_j, and keeps its length.
std::vector<glm::vec3> posedNormals(const Mesh& mesh, const Object& object);

// Returns whether the object has a skin or a nonzero morph weight.
bool deformed(const Object& object);

// Returns a world-space bounding box of the vertices that triangles use. The box is exact for deformed objects; for
// other objects, it encloses the transformed bounding box of the mesh.
Bounds posedBounds(const Mesh& mesh, const Object& object);

// Same as posedBounds(mesh, object), where `meshBounds` is mesh.bounds(), computed in advance.
Bounds posedBounds(const Mesh& mesh, const Bounds& meshBounds, const Object& object);

// Returns the world-space bounding box of the pose's objects except the ground. Computes the bounding box of each mesh
// only once.
Bounds posedBounds(const Scene& scene, const Pose& pose);

}  // namespace defocus::engine
