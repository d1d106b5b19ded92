#pragma once
// Derives warnings about an image from its plan, its request and its scene.

#include <cstdint>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns a warning with a remedy for each of the following cases that applies:
// - The lens is open, but the largest blur is below half a pixel.
// - The frame has transmitting materials, but the method draws them opaque.
// - The frame has shadows, but the method draws none.
// - The method draws one image per lens sample, and the blur is so large that these images show as separate copies. In
//   a blur disk of diameter c px, the copies from N lens samples are about c·√(π/(4N)) px apart. With lens cells
//   (plan/lens_cells/lens_cells.h), the image of each sample is blurred to fill these gaps. The warning then appears if
//   the required blur exceeds the maximum of lens cells.
// `samples`: the frame's total number of lens samples, for a plan that covers only the last block of them; 0: the
// number in the plan.
std::vector<std::string> planWarnings(const FramePlan& plan, const MethodUse& use, std::uint64_t samples = 0);

// Returns a line for each feature of the scene's file that isn't drawn, up to 20 lines, and a line with the number of
// features that are not listed. damageWarnings (frame/setup/prepared_frame.h) reports faults of the file.
std::vector<std::string> ignoredWarnings(const Scene& scene);

// Returns all warnings about a request that need no plan: about the scene, the camera, and settings without effect.
std::vector<std::string> requestWarnings(const Request& request, const PreparedFrame& frame);

}  // namespace defocus::engine
