#pragma once
// Warnings about a picture that follow from its plan, its request and its scene.

#include <cstdint>
#include <string>
#include <vector>

#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns a warning with a remedy for each of these cases:
// - The lens is open, but the largest blur is below half a pixel.
// - The method draws transmitting materials opaque, and the frame has such materials.
// - The method draws no shadows, and the frame has shadows.
// - The method draws an image per lens sample, and the blur is so large that these images show as copies. N points in a
//   disk of c px lie about c·√(π/(4N)) px apart. Lens cells (plan/lens_cells/lens_cells.h) fill gaps up to their widest
//   blur.
// `samples`: number of lens samples in the whole frame, if `plan` covers only its last block; 0: the plan's number.
std::vector<std::string> planWarnings(const FramePlan& plan, const MethodUse& use, std::uint64_t samples = 0);

// Returns a line for each kind of thing in the scene's file that isn't drawn, up to 20, and a line for the number of
// further kinds. damageWarnings (frame/setup/prepared_frame.h) reports faults of the file.
std::vector<std::string> ignoredWarnings(const Scene& scene);

// Returns all warnings of a request that need no plan: about the scene, the camera, and settings without effect.
std::vector<std::string> requestWarnings(const Request& request, const PreparedFrame& frame);

}  // namespace defocus::engine
