#pragma once
// Groups of neighbouring points of the lens, for whatever is blurred so little that one image serves a whole group.

#include <cstdint>
#include <span>
#include <vector>

#include "lens/lens_samples.h"

namespace defocus::engine {

// Returns an order of `samples` in which run g of `groupSize` samples, the last one perhaps shorter, are neighbours of
// images[g] on the lens: both sets are halved across the longer side of the samples again and again, always between
// whole groups. Samples within a group stay in their order. A prefix of the order is as spread over the lens as the
// same prefix of `images`. `groupSize` ≥ 1, and there are as many images as groups.
std::vector<std::uint32_t> groupedOrder(std::span<const LensSample> samples, std::span<const LensSample> images,
                                        std::uint32_t groupSize);

}  // namespace defocus::engine
