#pragma once
// A FramePlan in words: a table for people, JSON for programs.

#include <string>

#include "plan/frame_plan.h"

namespace defocus {

std::string planTable(const FramePlan& plan);
// Keys: image, lens, samples, shutter, objects[] (name, depth, coc, projectedEdge, lambda, blended, moves, draws[], and
// boundaryShare where the first of the draws shares its last sample with the second), leftOut[], triangles.
std::string planJson(const FramePlan& plan);

}  // namespace defocus
