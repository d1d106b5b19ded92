#include "plan/visible/light_shares.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/luminance.h"
#include "plan/visible/environment_directions.h"

namespace defocus::engine {

namespace {

// Returns the illuminance in lux on a surface that faces the light. The light's colour is converted to luminance.
double illuminance(const PlacedLight& placed, const glm::dvec3& camera, const SeenPoint& seen) {
    const Light& light = placed.light;
    const double brightness = light.intensity * luminance(glm::dvec3(light.color));
    if (!std::isfinite(brightness)) return 0;
    if (light.type == LightType::directional) return brightness;
    const glm::dvec3 offset = seen.place - (placed.position - camera);
    const double distance = glm::length(offset);
    if (light.range > 0 && distance > light.range + seen.spread) return 0;
    if (light.type == LightType::spot &&
        glm::dot(offset, placed.direction) + seen.spread < distance * std::cos(double{light.outerConeAngle}))
        return 0;
    const double bounded = std::max({distance, seen.spread, double{light.radius}, 1e-9});
    return brightness / (bounded * bounded);
}

// Returns the illuminance from each light, then from the environment, each summed over the visible points `seen`.
std::vector<double> illuminances(const World& world, const FramePlan& plan, double byEnvironment,
                                 const std::vector<SeenPoint>& seen) {
    const glm::dvec3 camera(plan.view.worldFromCamera[3]);
    std::vector<double> sums(world.lights.size() + 1, 0.0);
    for (const SeenPoint& point : seen) {
        for (std::size_t i = 0; i < world.lights.size(); ++i) sums[i] += illuminance(world.lights[i], camera, point);
        sums.back() += byEnvironment;
    }
    return sums;
}

double total(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// Returns the values divided by their sum, or zeros if the sum is 0.
std::vector<double> normalized(std::vector<double> values) {
    const double all = total(values);
    for (double& value : values) value = all > 0 ? value / all : 0;
    return values;
}

}  // namespace

std::vector<double> lightShares(const World& world, const FramePlan& plan,
                                const std::vector<std::vector<SeenPoint>>& rays) {
    const double byEnvironment =
        EnvironmentDirections(world.environment).meanIlluminance() * std::max(0.0f, world.environment.lighting);
    std::vector<double> shares(world.lights.size() + 1, 0.0);
    for (const std::vector<SeenPoint>& ray : rays) {
        const std::vector<double> ofRay = normalized(illuminances(world, plan, byEnvironment, ray));
        for (std::size_t i = 0; i < shares.size(); ++i) shares[i] += ofRay[i];
    }
    return normalized(std::move(shares));
}

}  // namespace defocus::engine
