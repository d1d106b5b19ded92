#pragma once
// Extracts a range of lens samples from a plan, so that several machines can share a frame. Each sample keeps the
// levels that it has in the complete frame.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns the plan for samples [first, first + count) of `plan`. `plan` must contain all of them. Sample i of the
// result is sample first + i of `plan`. Objects that these samples do not draw stay in the result.
FramePlan samplesOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

// Returns the number of triangles that samples [first, first + count) of `plan` draw.
std::uint64_t trianglesDrawn(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

}  // namespace defocus::engine
