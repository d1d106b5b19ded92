#pragma once
// Writes a FramePlan as text: as a table for people, and as JSON for programs.

#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

std::string planTable(const FramePlan& plan);
// The keys are image, lens, samples, shutter, objects[], leftOut[] and triangles. An object has name, depth, coc,
// projectedEdge, lambda, blended, transmits, moves and draws[], and boundaryShare if its first draw shares its last
// sample with the second.
std::string planJson(const FramePlan& plan);

}  // namespace defocus::engine
