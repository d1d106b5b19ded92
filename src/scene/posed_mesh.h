#pragma once
// Poses vertices on the CPU: applies morph targets, then the skin or the object's matrix (glTF 2.0, 3.7.2.2 and 3.7.3).
// The renderer's GPU code performs the same computation and is tested against this code.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/pose.h"

namespace defocus::engine {

// Returns the world-space position in m of each vertex: p' = Σ w_j · M_j · (p + Σ m_t · d_t) / Σ w_j for the mesh
// position p, with joint weights w_j and matrices M_j, and morph weights m_t and displacements d_t. Weights that are
// negative, NaN or infinite count as 0. Invalid joint indices, and vertices without weights, use the skin's first
// joint.
std::vector<glm::dvec3> posedPositions(const Mesh& mesh, const Object& object);

// Returns the matrix of a vertex, Σ w_j · M_j / Σ w_j. `joints` holds the matrices M_j, at least one.
glm::dmat4 skinMatrix(const Vertices& vertices, std::span<const glm::dmat4> joints, std::size_t vertex);

// Adds Σ m_t · d_t to `values`, which are positions or normals. `weights` holds the weight m_t of each morph target,
// and d_t is the target's displacement. `source[i]` is the mesh vertex of value i; if `source` is empty, value i
// belongs to vertex i.
void addMorphs(const Mesh& mesh, std::span<const double> weights, std::vector<glm::vec3> MorphTarget::*kind,
               std::span<const std::uint32_t> source, std::vector<glm::dvec3>& values);

// Returns world-space normals, transformed by the inverse transpose of each vertex's matrix (see skinMatrix), with the
// length of the morphed mesh normals. Returns an empty vector if the mesh has no normals.
std::vector<glm::vec3> posedNormals(const Mesh& mesh, const Object& object);

// Returns whether the object has a skin or a nonzero morph weight.
bool deformed(const Object& object);

// Returns a world-space bounding box of the vertices that triangles use. The box is exact for deformed objects; for
// other objects, it encloses the transformed bounding box of the mesh.
Bounds posedBounds(const Mesh& mesh, const Object& object);

// Same as posedBounds(mesh, object), where `meshBounds` is mesh.bounds(), computed in advance.
Bounds posedBounds(const Mesh& mesh, const Bounds& meshBounds, const Object& object);

}  // namespace defocus::engine
