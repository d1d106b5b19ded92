#pragma once
// Extracts a range of lens samples from a plan, so that several machines can share a frame. Levels and their division
// among samples remain those of the complete frame.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns the plan for samples [first, first + count) of `plan`: sample i of the result is sample first + i. The range
// must lie within the plan. Objects without any of these samples stay in the plan.
FramePlan samplesOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

// Returns the number of triangles that samples [first, first + count) of `plan` draw.
std::uint64_t trianglesDrawn(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

}  // namespace defocus::engine
