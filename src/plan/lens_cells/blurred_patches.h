#pragma once
// Computes the size of the surface patch that a single pixel averages over. The size follows from the blur and the
// pixel's own width.

#include <array>
#include <cstddef>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr std::size_t patchDepths = 5;

// Returns the side lengths of the patches, in object units, at depths evenly spaced over the object's bounding box. The
// box must lie beyond the near plane. A patch is a square of side √(1 + ¾c²) px for a blur disk of diameter c px. The
// square has the same variance along an axis as the disk convolved with a pixel. c is the CoC in the middle of the
// image, clamped to the object's range of CoCs. With LodCoc::centre, all entries are the patch at the box's centre.
// RenderSettings::lodCause can omit the disk or the pixel from the convolution.
std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan);

// Returns the smallest |CoC| in px over a range of depths and image positions (`box`). If RenderSettings::refocus is
// set, the result is the min over all its focus distances.
double smallestCoc(const FramePlan& plan, const CocBox& box);

// Returns the projected length in px of one unit of object space, at the depth of the bounding box's centre.
double pixelsPerUnitAtCentre(const ObjectPlan& object, const FramePlan& plan);

// Returns the smallest |CoC| in px at the centre of the object's view-space box. The minimum is over the blur modifiers
// of the object's surfaces, all wavelengths and, if set, RenderSettings::refocus.
double cocAtCentre(const ObjectPlan& object, const FramePlan& plan);

}  // namespace defocus::engine
