#pragma once
// Converts plans and pyramids to the public structs and to JSON.

#include <nlohmann/json.hpp>

#include "defocus/plan.h"
#include "defocus/pyramid.h"
#include "lod/pyramid/pyramid.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

defocus::Plan reportedPlan(const FramePlan& plan);

// Converts a mesh's pyramid to the public struct. `mesh`: index of the mesh in the scene.
defocus::Pyramid reportedPyramid(const Pyramid& pyramid, const std::string& name, std::size_t mesh);

nlohmann::ordered_json jsonOf(const defocus::Pyramid& pyramid);

// Returns, as text for users, why a pyramid has no coarser level.
std::string_view endReason(PyramidEnd end);

}  // namespace defocus::engine
