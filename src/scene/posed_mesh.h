#pragma once
// The vertices of an object as its pose has them: morph targets, then the skin or the object's place (glTF 2.0, 3.7.2.2
// and 3.7.3). The renderer does the same on the GPU; this is for all that needs vertices on the CPU, and its truth.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

// A vertex is p' = Σ w_j · M_j · (p + Σ m_t · d_t) / Σ w_j with joint weights w and morph weights m. A weight that is
// no number counts as 0, the skin's first joint for those that it lacks, and for vertices without any.
std::vector<glm::dvec3> posedPositions(const Mesh& mesh, const Object& object);  // world space, m

// The matrix of a vertex, Σ w_j · M_j / Σ w_j, over the joints' matrices M, of which there is at least one.
glm::dmat4 skinMatrix(const Vertices& vertices, std::span<const glm::dmat4> joints, std::size_t vertex);

// Adds Σ m_t · d_t, of positions or normals, with a weight for each morph target of the mesh. `source` says which
// vertex of the mesh each value is; empty: value i is vertex i.
void addMorphs(const Mesh& mesh, std::span<const double> weights, std::vector<glm::vec3> MorphTarget::*kind,
               std::span<const std::uint32_t> source, std::vector<glm::dvec3>& values);

// Normals turn with the inverse transpose of Σ w_j · M_j; world space, each as long as the mesh's (which morph targets
// may change). Empty where the mesh has none.
std::vector<glm::vec3> posedNormals(const Mesh& mesh, const Object& object);

// Does the pose move the vertices against each other?
bool deformed(const Object& object);

// Of the vertices that triangles use; world space. Exact where the object is deformed, else the transformed box of the
// mesh.
Bounds posedBounds(const Mesh& mesh, const Object& object);

// As posedBounds, for `meshBounds` that were measured before.
Bounds posedBounds(const Mesh& mesh, const Bounds& meshBounds, const Object& object);

}  // namespace defocus::engine
