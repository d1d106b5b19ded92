#pragma once
// Size of the surface patch that a single pixel averages over, due to the blur and the pixel's own width.

#include <array>
#include <cstddef>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::size_t patchDepths = 5;

// Returns the sides of the patches, in object units, at depths evenly spaced over the object's box. The box must lie in
// front of the near plane. A patch is a square of side √(1 + ¾c²) px for a blur disk of diameter c. Its variance along
// an axis equals that of the disk convolved with a pixel. The circle of confusion is taken in the middle of the image
// and clamped to the range in the box. With LodCoc::centre, the box's centre replaces all depths.
// RenderSettings::lodCause can omit the disk or the pixel.
std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan);

// Returns the length of an object unit in px at the depth of the box's centre.
double pixelsPerUnitAtCentre(const ObjectPlan& object, const FramePlan& plan);

// Returns the diameter of the circle of confusion at the centre of the object's box in view space, px.
double cocAtCentre(const ObjectPlan& object, const FramePlan& plan);

}  // namespace defocus::engine
