#pragma once
// Shades the hit of a single ray: unlit, or Lambert under the scene's lights, with or without shadows. The environment
// doesn't light surfaces. packet_shading.h shades packets.

#include <cstdint>

#include "embree/traced_scene.h"

namespace defocus::engine {

// A hit of a ray with a surface in camera space, as Embree reports it.
struct SurfaceHit {
    std::uint32_t triangle = 0;  // index of the triangle in its primitive
    float u = 0;                 // barycentric weight of the triangle's second corner
    float v = 0;                 // barycentric weight of the triangle's third corner
    glm::vec3 facet{0.0f};       // triangle normal, not normalised
    glm::vec3 direction{0.0f};   // direction of the ray
    float distance = 0;          // ray parameter at the hit: distance in units of the length of `direction`
    glm::vec3 origin{0.0f};
};

// Shadow rays to one point on each light. The point is given as (r, s) ∈ [0, 1)² and mapped to the light's disk.
struct ShadowRays {
    const TracedScene* scene = nullptr;  // scene for shadow rays; null: no shadows
    glm::vec2 lightPoint{0.5f};
};

// Returns the linear radiance from a hit towards the camera. The base colour is factor × vertex colour × texture, read
// from texture level 0.
glm::vec3 surfaceRadiance(const World& world, const TracedGeometry& geometry, const SurfaceHit& hit,
                          const ShadowRays& shadows);

}  // namespace defocus::engine
