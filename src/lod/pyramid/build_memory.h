#pragma once
// Keeps the construction of pyramids within a memory limit.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Returns an upper bound on the bytes that buildPyramid takes while it builds the pyramid of `mesh`, including the
// result. The bound fits measurements of meshes with 576 to 998,000 triangles
// (tests/lod/pyramid/build_memory_test.cpp).
std::uint64_t bytesToBuild(const Mesh& mesh, const PyramidOptions& options);

// Throws Error if the process would exceed options.memoryLimit while it builds the pyramid of `mesh`, unless that takes
// at most 1 MiB. The message says which limit is enough.
void requireRoomToBuild(const Mesh& mesh, const PyramidOptions& options);

// Calls build(i, options) for each mesh, the mesh with the most triangles first, so that no core is left with a large
// mesh at the end. If options.memoryLimit has room for all pyramids, the calls run on all cores and receive options
// without a limit. Otherwise they run one after another. Rethrows the first exception of a call.
using BuildOne = std::function<void(std::size_t mesh, const PyramidOptions& options)>;
void buildLargestFirst(const std::vector<Mesh>& meshes, const PyramidOptions& options, const BuildOne& build);

}  // namespace defocus::engine
