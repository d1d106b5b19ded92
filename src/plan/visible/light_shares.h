#pragma once
// Estimates how much each light contributes to the image, to choose the lights that cast shadows.

#include <vector>

#include "plan/frame_plan.h"
#include "plan/visible/seen_points.h"

namespace defocus::engine {

// Returns the mean share of each light in the illuminance of the surfaces that the image shows. There is one share for
// each of World::lights, then one for the environment. They add up to 1, or are all 0 if nothing visible is lit. Each
// of the `rays` (seenPoints()) counts the same, so a lamp matters as much as the part of the image that it lights.
// Occlusion and the angle of incidence are ignored.
std::vector<double> lightShares(const World& world, const FramePlan& plan,
                                const std::vector<std::vector<SeenPoint>>& rays);

}  // namespace defocus::engine
