#pragma once
// Shades a surface for a single ray: unlit, or Lambert under the scene's lights, with or without shadows. The
// environment gives no light. packet_shading.h shades packets.

#include <cstdint>

#include "embree/traced_scene.h"

namespace defocus::engine {

// A hit as Embree reports it, in camera space.
struct SurfaceHit {
    std::uint32_t triangle = 0;  // triangle of the primitive
    float u = 0;                 // weight of the triangle's second corner
    float v = 0;                 // weight of the third corner
    glm::vec3 facet{0.0f};       // normal of the triangle, any length
    glm::vec3 direction{0.0f};   // direction of the ray
    float distance = 0;          // distance in units of `direction`
    glm::vec3 origin{0.0f};
};

// Shadow rays to one point on each light: (r, s) ∈ [0, 1)² on its disk.
struct ShadowRays {
    const TracedScene* scene = nullptr;  // null: no shadows
    glm::vec2 lightPoint{0.5f};
};

// Returns the linear radiance of a hit towards the camera. The base colour is factor × vertex colour × texture at level
// 0.
glm::vec3 surfaceRadiance(const World& world, const TracedGeometry& geometry, const SurfaceHit& hit,
                          const ShadowRays& shadows);

}  // namespace defocus::engine
