#pragma once
// Makes a plan of a part of a frame's lens samples, so that several machines can share a frame. The levels and their
// split stay those of the whole frame.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns the plan of samples [first, first + count) of `plan`: sample i of the result is sample first + i. The range
// must lie within the plan. Objects stay in the plan even if none of these samples draws them.
FramePlan samplesOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

// Returns how many triangles samples [first, first + count) of `plan` draw.
std::uint64_t trianglesDrawn(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

}  // namespace defocus::engine
