#pragma once
// Computes the irradiance from an environment, as coefficients of a polynomial that shaders/include/environment.glsl
// evaluates.

#include <array>
#include <glm/vec4.hpp>

#include "scene/scene.h"

namespace defocus::engine {

// Returns coefficients of irradiance over π as a function of the unit normal n. A gradient gives the zonal polynomial
// c0 + c1·n.y + c2·n.y². A map gives the nine coefficients of second-order spherical harmonics (Ramamoorthi and
// Hanrahan 2001), in the order 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y². Other environment types give zeros.
std::array<glm::vec4, 9> diffuseCoefficients(const Environment& environment);

}  // namespace defocus::engine
