#pragma once
// Divides lens points evenly among lens samples: each sample gets the same number of nearby points.

#include <cstdint>
#include <span>
#include <vector>

#include "lens/lens_samples.h"

namespace defocus::engine {

// Returns indices of `points`, ordered so that entries [g·share, (g + 1)·share) lie near centres[g] on the lens. Points
// and centres are halved recursively across the longer side of the points' bounding box (Bentley 1975, Multidimensional
// Binary Search Trees Used for Associative Searching). Points of the same centre keep their order. Requires share ≥ 1
// and points.size() = share · centres.size().
std::vector<std::uint32_t> evenDivision(std::span<const LensSample> points, std::span<const LensSample> centres,
                                        std::uint32_t share);

}  // namespace defocus::engine
