#pragma once
// Keeps the construction of pyramids (meshes with levels of detail) within a memory limit.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Returns an upper bound on the bytes that buildPyramid allocates for `mesh`, including the result. The bound was
// checked for meshes with 576 to 998,000 triangles (tests/lod/pyramid/build_memory_test.cpp).
std::uint64_t bytesToBuild(const Mesh& mesh, const PyramidOptions& options);

// Throws Error if building the pyramid of `mesh` would make the process exceed options.memoryLimit; the message states
// a sufficient limit. Never throws for a pyramid that takes at most 1 MiB.
void requireRoomToBuild(const Mesh& mesh, const PyramidOptions& options);

// Returns whether the memory limit allows building on all cores. In the worst case, the largest meshes are built at the
// same time, one per core, while all other pyramids are already finished. `order` holds mesh indices, the largest mesh
// first.
bool fitsInParallel(const std::vector<Mesh>& meshes, const std::vector<std::size_t>& order,
                    const PyramidOptions& options);

}  // namespace defocus::engine
