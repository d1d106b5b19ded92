#pragma once
// Which alpha-blended objects are blurred together: Garcia 2018 puts transparent surfaces into buckets by their depth,
// and each bucket has a blur of its own.

#include <cstdint>
#include <vector>

#include "gl/texture.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

// Objects of the plan, front to back.
using TransparencyBucket = std::vector<std::size_t>;

// At most `most` buckets, the farthest first: runs of blended objects, parted where the blur in the middle of one
// differs most from that of the next. Objects whose blurs differ by less than a pixel share a bucket. What may be seen
// through a transmitting surface is in none, as that surface shows what is drawn with it; nor is anything where the
// lens blurs nothing.
std::vector<TransparencyBucket> transparencyBuckets(const FramePlan& plan, std::uint32_t max);

// The part of the image, in px from its lower left corner, where a blur may show something of a bucket; empty where
// nothing is.
TexelRectangle reachOf(const TransparencyBucket& bucket, const FramePlan& plan);

}  // namespace defocus::engine
