#pragma once
// Soft shadows from the same samples as the blur (Haeberli and Akeley 1990): each lens sample has a point on every
// light, and a shadow map drawn from there. The mean of the samples has the penumbrae.
//
// Lights are disks that face what they shine on: of an angular diameter where they are infinitely far, of a radius
// elsewhere. The surroundings, if they light the scene, are one more light, whose point is a direction that is chosen
// by their radiance; what hides it takes its part from the light that a surface has from all around.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline constexpr int surroundings = -1;  // as a light
// A sample: weaker lights cast no shadow. What they leave is for several points on each light, where samples are few.
inline constexpr std::size_t maxShadowMaps = 8;

// Directions to the surroundings, the brighter the more often: of an equirectangular grid, cell by cell.
class EnvironmentDirections {
public:
    EnvironmentDirections() = default;
    explicit EnvironmentDirections(const Environment& environment);

    struct Choice {
        glm::dvec3 toLight{0, 1, 0};  // unit
        glm::dvec3 radiance{0.0};     // over its probability density, W/m²/sr · sr
    };
    // `point`: in [0, 1)².
    [[nodiscard]] Choice at(const glm::dvec2& point) const;
    [[nodiscard]] bool empty() const { return rowSums_.empty() || !(rowSums_.back() > 0); }

private:
    std::vector<glm::dvec3> radiances_;
    std::vector<double> rowSums_;   // of luminance times solid angle, from the top on
    std::vector<double> cellSums_;  // within the row
};

// How one shadow map is drawn and read. Places are metres from the camera along the world's axes.
struct ShadowProjection {
    std::array<glm::vec4, 4>
        clipRows{};            // clip space from (x, y, z, 1), reversed depth; w is 1, or metres from the light
    glm::vec3 toLight{0.0f};   // unit, of lights that are infinitely far
    float texel = 0;           // m a texel at w = 1
    glm::vec3 radiance{0.0f};  // of the surroundings, as EnvironmentDirections has it, over π
};

// On each light, without more maps a sample than `mostShadowMaps`; `maps`: one of each light's.
std::uint32_t maxPointsPerSample(std::size_t maps);

// Chooses lights, points, size and casters. `objects`: all of the world's, as the plan places them, drawn or not.
ShadowPlan planShadows(const World& world, const FramePlan& plan, const std::vector<ObjectPlan>& objects);

// Those of all samples of the plan: plan.shadows.points of each, of each all maps.
std::vector<ShadowProjection> shadowProjections(const World& world, const FramePlan& plan,
                                                const EnvironmentDirections& directions);

// The concentric map of the square [0, 1)² to the unit disk (Shirley and Chiu 1997).
glm::dvec2 diskPoint(const glm::dvec2& point);

}  // namespace defocus::engine
