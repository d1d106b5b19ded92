#pragma once
// The patches of an object that one pixel shows the mean of: by the blur, and by the pixel itself.

#include <array>
#include <cstddef>

#include "plan/frame_plan.h"

namespace defocus {

inline constexpr std::size_t patchDepths = 5;

// Their sides, object units, at depths evenly spread over the object's box, which lies in front of the near plane. A
// disk of diameter c and a pixel, both as wide as the square of side √(1 + ¾c²) px by their variance along an axis. The
// circle of confusion is the one in the middle of the image, within the box's range; with
// RenderSettings::lodCocAtCentre the box's centre stands for all depths. RenderSettings::lodCause takes one of the two
// alone.
std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan);

// At the centre of the object's box in view space, px.
double cocAtCentre(const ObjectPlan& object, const FramePlan& plan);

}  // namespace defocus
