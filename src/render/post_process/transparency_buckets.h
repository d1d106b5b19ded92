#pragma once
// Groups alpha-blended objects that are blurred together. Garcia 2018 sorts transparent surfaces into buckets by depth,
// and blurs each bucket separately.

#include <cstdint>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Indices of objects of the plan, front to back.
using TransparencyBucket = std::vector<std::size_t>;

// Returns at most `max` buckets, the farthest first. Each is a run of blended objects in depth order, split at the
// largest differences between the mid blurs of neighbouring objects. Objects whose blurs differ by less than a pixel
// share a bucket. Objects that may be visible through a transmitting surface are in no bucket, since that surface
// copies the image drawn before it. Without lens blur there are no buckets.
std::vector<TransparencyBucket> transparencyBuckets(const FramePlan& plan, std::uint32_t max);

// Returns the rectangle of the image, in px from its lower left corner, that the blurred bucket may touch. Empty for an
// empty bucket.
TexelRectangle reachOf(const TransparencyBucket& bucket, const FramePlan& plan);

}  // namespace defocus::engine
