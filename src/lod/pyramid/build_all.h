#pragma once
// Obtains the pyramids of all meshes of a scene, on all cores as far as the memory limit allows.

#include <functional>
#include <vector>

#include "core/progress.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Returns the pyramid of a mesh. `build` builds it; a cache calls `build` only for a pyramid that it doesn't hold.
using ObtainPyramid = std::function<Pyramid(std::size_t mesh, const std::function<Pyramid()>& build)>;

// Calls `obtain` for each mesh and returns the pyramids in the order of the meshes. The mesh with the most triangles
// comes first, so that no core is left with a large mesh when the others are done. If all pyramids fit into
// options.memoryLimit, the calls run on all cores. Otherwise, they run one after another. Rethrows the first exception
// of a call. Reports the progress of the stage "pyramids", weighted by triangle count.
std::vector<Pyramid> obtainPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options,
                                    const Progress& progress, const ObtainPyramid& obtain);

// Builds one pyramid per mesh. Throws Error in the same cases as buildPyramid.
std::vector<Pyramid> buildPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options = {},
                                   const Progress& progress = {});

}  // namespace defocus::engine
