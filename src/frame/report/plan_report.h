#pragma once
// Plans and pyramids as the public structs, and the JSON of both.

#include <nlohmann/json.hpp>

#include "defocus/plan.h"
#include "defocus/pyramid.h"
#include "lod/pyramid/pyramid.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

defocus::Plan reportedPlan(const FramePlan& plan);

// Returns a mesh's pyramid. `mesh`: index of the mesh in the scene.
defocus::Pyramid reportedPyramid(const Pyramid& pyramid, const std::string& name, std::size_t mesh);

nlohmann::ordered_json jsonOf(const defocus::Pyramid& pyramid);

// Returns the text of a JSON document, with a line break at its end. Invalid UTF-8 is replaced.
std::string documentText(const nlohmann::ordered_json& json);

// Returns why a pyramid has no further level, for people.
std::string_view endReason(PyramidEnd end);

}  // namespace defocus::engine
