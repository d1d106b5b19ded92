#pragma once
// Why a pyramid has no further level.

#include <cstdint>

namespace defocus::engine {

enum class PyramidEnd : std::uint32_t {
    minTriangles,  // the last level is as small as levels get
    smallSaving,   // one of the least triangles would save less than a quarter
    topology,      // collapses come no further: handles, cuts and borders need the triangles that are left
    largestParts,  // only parts with much of the area could still be made smaller
    noSurface,     // no triangle has corners apart from each other
    maxLevels,     // there are as many as asked for
};
constexpr PyramidEnd lastPyramidEnd = PyramidEnd::maxLevels;

}  // namespace defocus::engine
