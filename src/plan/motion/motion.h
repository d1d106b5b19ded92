#pragma once
// Finds what moves while the shutter is open, for a plan.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Throws Error if the shutter's poses and cameras don't belong to one scene at the same moments, or if there are fewer
// of them than the samples need.
void checkShutter(const World& world, const View& view, const RenderSettings& settings);

// Returns the poses of an object at the moments of the shutter, each in the view space of that moment. The result is
// empty if they all equal `pose`, to a billionth of the size of its matrices: the object doesn't move relative to the
// camera.
std::vector<ObjectPose> objectMotion(const World& world, const View& view, std::size_t object, const ObjectPose& pose);

// Returns whether the shutter is open for more than a moment.
bool shutterIsOpen(const World& world, const View& view);

// Fills plan.moments and plan.middleFromView. They stay empty if none of the plan's objects moves and no blur of
// vertices changes.
void planMoments(FramePlan& plan, const World& world, const std::vector<ObjectPlan>& casters);

}  // namespace defocus::engine
