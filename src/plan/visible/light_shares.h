#pragma once
// Estimates how much each light contributes to the image. The estimate chooses the lights that cast shadows.

#include <vector>

#include "plan/frame_plan.h"
#include "plan/visible/seen_points.h"

namespace defocus::engine {

// Returns the mean share of each light in the illuminance of the surfaces visible in the image. The result has one
// share per light of World::lights, then one for the environment. The shares add up to 1, or are all 0 if nothing
// visible is lit. All `rays` (from seenPoints()) have equal weight, so a lamp's share grows with the part of the image
// that it lights. Occlusion and the angle of incidence are ignored.
std::vector<double> lightShares(const World& world, const FramePlan& plan,
                                const std::vector<std::vector<SeenPoint>>& rays);

}  // namespace defocus::engine
