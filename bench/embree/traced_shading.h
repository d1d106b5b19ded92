#pragma once
// What a single ray sees of a surface: unlit surfaces, Lambert under the lights of the scene, with or without shadows
// (nothing from the environment). What packets see, packet_shading.h.

#include <cstdint>

#include "embree/traced_scene.h"

namespace defocus::engine {

// As Embree gives it; camera space.
struct SurfaceHit {
    std::uint32_t triangle = 0;  // of the primitive
    float u = 0;                 // weight of the triangle's second corner
    float v = 0;                 // of its third
    glm::vec3 facet{0.0f};       // normal of the triangle, any length
    glm::vec3 direction{0.0f};   // of the ray
    float distance = 0;          // along it, in its lengths
    glm::vec3 origin{0.0f};
};

// What stands before the lights: rays go to a point of each, (r, s) ∈ [0, 1)² of its disk.
struct ShadowRays {
    const TracedScene* scene = nullptr;  // null: nothing casts a shadow
    glm::vec2 lightPoint{0.5f};
};

// Linear radiance towards the camera at a hit. Base colour: factor × vertex colour × texture at level 0.
glm::vec3 surfaceRadiance(const World& world, const TracedGeometry& geometry, const SurfaceHit& hit,
                          const ShadowRays& shadows);

}  // namespace defocus::engine
