#pragma once
// Repairs and completes vertex attributes of meshes from glTF files and from memory.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

// Makes all attributes valid; positions must be finite. Normals and tangents get unit length, and skin weights sum to
// 1. Replaces non-finite and near-zero normals by smooth normals, and non-finite and near-zero tangents by vectors
// perpendicular to the normals. Returns the number of replaced normals.
std::size_t repairAttributes(VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Returns the entry of Scene::ignored that tells users about `count` normals replaced by repairAttributes.
Ignored replacedNormalsNote(std::size_t count);

// Returns the texture coordinate set to which tangents must be aligned: the set of the first normal map or anisotropic
// material of the primitives. Returns −1 if there is neither.
int tangentUvSet(std::span<const Primitive> primitives, std::span<const Material> materials);

// Adds flat normals if normals are missing, as glTF requires. Adds missing tangents aligned to the texture coordinate
// set `tangentUvs` (0 or 1; −1: adds no tangents). Updates `indices`.
VertexBlock withMissingAttributes(VertexBlock block, std::span<std::vector<std::uint32_t>* const> indices,
                                  int tangentUvs);

// Returns the label of the first node or object with a non-finite world matrix, such as "node 'Door'"; empty if all are
// finite. Finite local matrices can multiply to infinity.
std::string placedAtInfinity(const Scene& scene);

}  // namespace defocus::engine
