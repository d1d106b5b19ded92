#pragma once
// Prints a FramePlan as a table for people and as JSON for programs.

#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

std::string planTable(const FramePlan& plan);
// Returns the plan as JSON with the keys image, lens, samples, shutter, objects[], leftOut[] and triangles. An object
// has name, depth, coc, projectedEdge, lambda, blended, transmits, moves and draws[]. It also has boundaryShare if its
// two draws share a sample.
std::string planJson(const FramePlan& plan);

}  // namespace defocus::engine
