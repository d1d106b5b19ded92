#pragma once
// Says what a blur leaves of a difference: its root mean square once it is averaged over patches of growing size.

#include <array>
#include <cstddef>

namespace defocus {

// [0]: over no patch, point by point. [i], i ≥ 1: over square patches of side 2^(i − 1) · Pyramid::smallestPatch. Light
// is in units of the mesh's own mean, so that 1 is all of it.
inline constexpr std::size_t blurSizes = 10;
using BlurTable = std::array<float, blurSizes>;

}  // namespace defocus
