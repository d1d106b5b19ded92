#pragma once
// What a ray sees: unlit surfaces, Lambert under the directional lights of the scene (no shadows, nothing from the
// environment), and a uniform or gradient background evaluated exactly along the ray.

#include <embree3/rtcore.h>

#include "embree/traced_scene.h"

namespace defocus {

// Linear radiance towards the camera at a hit. Base colour: factor × vertex colour × texture at level 0.
glm::vec3 surfaceRadiance(const World& world, const TracedScene& scene, const RTCRayHit& ray);

// Radiance from infinity along a world-space direction (any length). Environment maps are not traced.
glm::vec3 backgroundRadiance(const Environment& environment, const glm::dvec3& direction);

}  // namespace defocus
