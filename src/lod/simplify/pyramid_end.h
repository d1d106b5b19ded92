#pragma once
// Lists the reasons why a pyramid (a mesh and its coarser levels of detail) has no further level.

#include <cstdint>

namespace defocus::engine {

enum class PyramidEnd : std::uint32_t {
    minTriangles,  // the last level has reached the minimum triangle count
    smallSaving,   // even the coarsest possible level would save less than a quarter of the triangles
    topology,      // no collapse preserves the topology: handles and borders need all remaining triangles
    largestParts,  // only components with a large fraction of the area could be simplified further
    noSurface,     // all triangles are degenerate
    maxLevels,     // the maximum number of levels is reached
};
constexpr PyramidEnd lastPyramidEnd = PyramidEnd::maxLevels;

}  // namespace defocus::engine
