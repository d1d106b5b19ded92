#pragma once
// Computes the patches of an object whose mean one pixel shows: the blur spreads them, and so does the pixel's own
// size.

#include <array>
#include <cstddef>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::size_t patchDepths = 5;

// Returns their sides, in object units, at depths evenly spread over the object's box, which must lie in front of the
// near plane. A disk of diameter c and a pixel, one after the other, spread a point as far as a square of side √(1 +
// ¾c²) px does: they have the same variance along an axis. The circle of confusion is the one in the middle of the
// image, clamped to those of the box. With LodCoc::centre, the box's centre stands for all depths.
// RenderSettings::lodCause can leave out the disk or the pixel.
std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan);

// Returns how many px an object unit is long at the depth of the box's centre.
double pixelsPerUnitAtCentre(const ObjectPlan& object, const FramePlan& plan);

// Returns the diameter of the circle of confusion at the centre of the object's box in view space, px.
double cocAtCentre(const ObjectPlan& object, const FramePlan& plan);

}  // namespace defocus::engine
