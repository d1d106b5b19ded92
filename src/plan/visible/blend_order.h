#pragma once
// Chooses how alpha-blended objects are drawn: back to front, or by stochastic transparency, where each lens sample
// shows or skips a fragment according to its alpha (Enderton et al. 2010, Stochastic Transparency). Sorting adds no
// noise, but it is right only where surfaces have one order in depth. Stochastic transparency needs no order.

#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns whether the primitive is part of the surface of a convex body whose fronts face outwards, such as a flat
// pane. From any viewpoint, its back faces lie behind its front faces, and neither overlap themselves. Primitives with
// more than 1,000 triangles are not tested and count as not convex.
bool isConvex(const Vertices& vertices, const Primitive& primitive);

// Sets ObjectPlan::blended and ObjectPlan::stochasticAlpha of all objects.
void chooseBlending(FramePlan& plan, const World& world);

}  // namespace defocus::engine
