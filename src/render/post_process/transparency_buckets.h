#pragma once
// Divides alpha-blended objects into buckets by depth; each bucket is blurred separately (Garcia 2018).

#include <cstdint>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Alpha-blended objects that are blurred together, as indices into FramePlan::objects, front to back.
using TransparencyBucket = std::vector<std::size_t>;

// Returns at most `max` buckets, the farthest first. The blended objects, in depth order, are divided where the blur
// differs most between neighbours. Neighbours whose blurs differ by less than 1 px are in the same bucket. Objects that
// may be visible through a transmitting surface are in no bucket: the surface refracts a copy of the image drawn before
// it, which must already contain these objects. Without lens blur, there are no buckets.
std::vector<TransparencyBucket> transparencyBuckets(const FramePlan& plan, std::uint32_t max);

// Returns a rectangle, in px from the image's lower left corner, that contains the blurred images of the bucket's
// objects; empty for an empty bucket.
TexelRectangle reachOf(const TransparencyBucket& bucket, const FramePlan& plan);

}  // namespace defocus::engine
