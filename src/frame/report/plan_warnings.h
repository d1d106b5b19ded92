#pragma once
// Warns of what a person should know about a picture, from its plan alone.

#include <cstdint>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns a line, with what helps, for each of these:
// - the lens is open, but nothing is blurred by half a pixel;
// - the method draws transmitting materials opaque, and there are some;
// - each lens sample of the method is an image of its own, and an object's blur is so large for
//   the number of samples that they show as copies: N points spread over a disk of c px lie about c·√(π/(4N)) px apart.
//   Lens cells (plan/lens_cells.h) fill that, as far as their widest blur reaches.
// `samples`: of the whole frame, where the plan is that of its last block; 0: the plan's.
std::vector<std::string> planWarnings(const FramePlan& plan, const MethodUse& use, std::uint64_t samples = 0);

// Returns a line for each thing in the scene's file that isn't drawn, up to 20. For faults of the file see
// damageWarnings (prepared_frame.h).
std::vector<std::string> ignoredWarnings(const Scene& scene);

// Returns all warnings of a request that need no plan: of the frame's scene and camera, and of settings without effect.
std::vector<std::string> requestWarnings(const Request& request, const PreparedFrame& frame);

}  // namespace defocus::engine
