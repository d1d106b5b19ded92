#pragma once
// Completion of vertex attributes, shared by all sources of meshes: glTF files and data in memory.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

// Makes all attributes valid; positions must be finite. Normals and tangents get unit length, and weights sum to 1.
// Non-finite and near-zero vectors are replaced. Returns the number of replaced normals.
std::size_t repairAttributes(VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices);

// Returns the note about normals that repairAttributes replaced.
Ignored replacedNormalsNote(std::size_t count);

// Returns the texture coordinate set of the first normal map among the primitives; −1 without normal maps.
int normalMapUvSet(std::span<const Primitive> primitives, std::span<const Material> materials);

// Adds missing normals by flat shading, as glTF requires. Adds missing tangents for a normal map with the texture
// coordinates `normalMapUvs` (0 or 1; −1: no normal map). Updates `indices`.
VertexBlock withMissingAttributes(VertexBlock block, std::span<std::vector<std::uint32_t>* const> indices,
                                  int normalMapUvs);

// Returns the first node or object whose world matrix is not finite, such as "node 'Door'"; empty if all are finite.
// Finite local matrices can multiply to infinity.
std::string placedAtInfinity(const Scene& scene);

}  // namespace defocus::engine
