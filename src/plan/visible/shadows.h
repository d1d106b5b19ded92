#pragma once
// Computes soft shadows with the same lens samples as the depth of field (Haeberli and Akeley 1990). Each lens sample
// has a point on every light and a shadow map rendered from that point. The mean over the samples shows soft shadows.
//
// Lights are disks that face the receiver. A directional light has an angular diameter; other lights have a radius. The
// surroundings (environment map) act as one more light if they light the scene. For the surroundings, each lens sample
// has a direction instead of a point, chosen in proportion to radiance. An occluder in that direction removes this
// sample's share of the surface's ambient light.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "plan/frame_plan.h"
#include "plan/visible/environment_directions.h"

namespace defocus::engine {

inline constexpr int surroundings = -1;  // value of ShadowMap::light for the environment
// Max number of shadow maps per sample. The weakest lights beyond this number cast no shadow. In frames with few
// samples, unused maps give each light several points per sample, for smoother penumbrae.
inline constexpr std::size_t maxShadowMaps = 8;

// Projection of a shadow map. Positions are relative to the camera, in m, in world axes.
struct ShadowProjection {
    // Rows of the matrix from camera-relative positions (see above) to clip space, with reversed depth. Clip-space w is
    // 1 for parallel light, else the depth in m.
    std::array<glm::vec4, 4> clipRows{};
    glm::vec3 toLight{0.0f};   // unit vector to a directional light or the environment
    float texel = 0;           // texel width in m at w = 1
    glm::vec3 radiance{0.0f};  // for the environment, EnvironmentDirections::Choice::radiance divided by π
};

// Returns the max number of points on each light for which a sample needs at most maxShadowMaps maps. `maps` is the
// number of maps for one point per light.
std::uint32_t maxPointsPerSample(std::size_t maps);

// Chooses the lights that cast shadows, the points on each light, the map size and the casters. Lights that cause less
// than 1 % of the illuminance of the visible surfaces cast no shadow. On surfaces in focus, a texel is at most two
// pixels wide. `objects` are all objects of the world in the plan's pose, including objects outside the image.
ShadowPlan planShadows(const World& world, const FramePlan& plan, const std::vector<ObjectPlan>& objects);

// Returns the directions from which the environment lights the world.
EnvironmentDirections environmentDirections(const World& world);

// Returns the projections of all maps, ordered by sample, then by point (plan.shadows.points per sample), then by map.
std::vector<ShadowProjection> shadowProjections(const World& world, const FramePlan& plan,
                                                const EnvironmentDirections& directions);

// Maps the square [0, 1)² to the unit disk with the concentric map (Shirley and Chiu 1997).
glm::dvec2 diskPoint(const glm::dvec2& point);

}  // namespace defocus::engine
