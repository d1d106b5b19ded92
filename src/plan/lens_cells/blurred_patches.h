#pragma once
// Computes the size of the surface patch that a single pixel averages over. The size follows from the blur and the
// pixel's own width.

#include <array>
#include <cstddef>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::size_t patchDepths = 5;

// Returns the sides of the patches, in object units, at depths evenly spaced over the object's bounding box. The box
// must lie in front of the near plane. A patch is a square of side √(1 + ¾c²) px for a blur disk of diameter c px. The
// square has the same variance along an axis as the disk convolved with a pixel. c is the CoC in the middle of the
// image, clamped to the range in the box. With LodCoc::centre, the box's centre replaces all depths.
// RenderSettings::lodCause can omit the disk or the pixel from the convolution.
std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan);

// Returns the smallest |CoC| in px over a range of depths and image positions (`box`). If RenderSettings::refocus is
// set, the result also covers all its focus distances.
double smallestCoc(const FramePlan& plan, const CocBox& box);

// Returns the projected length in px of one unit of object space, at the depth of the bounding box's centre.
double pixelsPerUnitAtCentre(const ObjectPlan& object, const FramePlan& plan);

// Returns the smallest |CoC| in px at the centre of the object's view-space box. The minimum is over the blur modifiers
// of the object's surfaces, all wavelengths and, if set, RenderSettings::refocus.
double cocAtCentre(const ObjectPlan& object, const FramePlan& plan);

}  // namespace defocus::engine
