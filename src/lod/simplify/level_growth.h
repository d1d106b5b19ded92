#pragma once
// Components that stand in for others grow until they have their area.

#include <glm/vec3.hpp>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/simplify.h"

namespace defocus {

// Scales those of the level's components that have less area than they are to stand for (SimplifiedLevel::growths). The
// result stays within `limits`. `positions` are those of the level's vertices.
void growComponents(std::vector<glm::vec3>& positions, const SimplifiedLevel& level, const Bounds& limits);

}  // namespace defocus
