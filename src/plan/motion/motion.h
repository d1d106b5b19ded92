#pragma once
// Plans the motion of objects and camera while the shutter is open.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Throws Error if the shutter has different numbers of poses and cameras, poses with different numbers of objects, or
// fewer shutter times than the samples need.
void checkShutter(const World& world, const View& view, const RenderSettings& settings);

// Returns the poses of an object at the shutter times, each in the view space of its time. The result is empty if the
// object doesn't move relative to the camera, which means that all poses equal `pose` within 1e-9 of each matrix's
// largest element.
std::vector<ObjectPose> objectMotion(const World& world, const View& view, std::size_t object, const ObjectPose& pose);

// Returns true if the exposure time is greater than 0.
bool shutterIsOpen(const World& world, const View& view);

// Fills plan.moments and plan.middleFromView. Both stay empty if no object and no shadow caster moves, and the blur
// that vertices add doesn't change.
void planMoments(FramePlan& plan, const World& world, const std::vector<ObjectPlan>& casters);

}  // namespace defocus::engine
