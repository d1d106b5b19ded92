#pragma once
// Chooses how alpha-blended primitives are drawn: back to front, or by stochastic transparency, where each lens sample
// shows or skips a fragment according to its alpha (Enderton et al. 2010, Stochastic Transparency). Sorting adds no
// noise, but it is correct only where surfaces have the same depth order for all lens points. Stochastic transparency
// needs no order.
//
// A convex primitive is one part; in other primitives, each triangle is a part. A part may be drawn before another if a
// plane separates it from the other part and the lens, because it then never hides the other part (Newell, Newell and
// Sancha 1972, A Solution to the Hidden Surface Problem). If two parts have no order, because they cross or because the
// lens sees both sides of their planes, one of them is drawn by stochastic transparency. If parts form a cycle, one of
// them is drawn in this way, too.

#include <span>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns whether the triangles are part of the surface of a convex body whose front faces point outwards, such as a
// flat pane. From any viewpoint, back faces lie behind front faces, and faces of the same orientation never overlap. A
// primitive with more than 1,000 triangles is not tested and counts as not convex.
bool isConvex(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> indices);

// Sets FramePlan::blendOrder and ObjectPlan::blended. The levels of the objects must already be chosen.
void chooseBlending(FramePlan& plan, const World& world);

}  // namespace defocus::engine
