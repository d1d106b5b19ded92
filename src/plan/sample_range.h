#pragma once
// A part of a frame's lens samples as a plan of its own, for a frame that several machines share: the levels and their
// split stay those of the whole frame.

#include "plan/frame_plan.h"

namespace defocus {

// Samples [first, first + count) of `plan`: sample i of the result is sample first + i. They must lie within the plan;
// objects are kept even where none of these samples draws them.
FramePlan samplesOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count);

}  // namespace defocus
