#pragma once
// What moves while the shutter is open, for a plan.

#include "plan/frame_plan.h"

namespace defocus {

// Throws Error when the shutter's poses and cameras aren't of one scene at the same moments, or fewer than the samples
// need.
void checkShutter(const World& world, const View& view, const RenderSettings& settings);

// An object at the shutter's moments, each in the space of the camera of that moment. Empty where it stands still
// before the camera, to a billionth of its matrices' size, as it does in `pose`.
std::vector<ObjectPose> objectMotion(const World& world, const View& view, std::size_t object, const ObjectPose& pose);

// Fills plan.moments and plan.middleFromView; they stay empty where none of the plan's objects moves.
void planMoments(FramePlan& plan, const World& world);

}  // namespace defocus
