#pragma once
// What a person should know of a picture, from its plan alone.

#include <string>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus {

// A line each, with what helps:
// - the lens is open, but nothing is blurred by half a pixel;
// - `samplesFill` (each sample is an image of its own, as the accumulation's are), and an object's blur is so large for
//   the number of samples that they show as copies: N points spread over a disk of c px lie about c·√(π/(4N)) px apart.
std::vector<std::string> planWarnings(const FramePlan& plan, bool samplesFill);

// What of the scene's file isn't drawn, a line each; faults of the file are damageWarnings (prepared_frame.h).
std::vector<std::string> ignoredWarnings(const Scene& scene);

}  // namespace defocus
