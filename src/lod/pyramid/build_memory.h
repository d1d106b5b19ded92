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

// Calls build(i, options) for each mesh i. The mesh with the most triangles comes first, so that no core is left with a
// large mesh when the others are done. If all pyramids fit into options.memoryLimit, the calls run on all cores and
// receive options without a limit. Otherwise, they run one after another. Rethrows the first exception of a call.
using BuildOne = std::function<void(std::size_t mesh, const PyramidOptions& options)>;
void buildLargestFirst(const std::vector<Mesh>& meshes, const PyramidOptions& options, const BuildOne& build);

}  // namespace defocus::engine
