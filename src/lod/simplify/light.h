#pragma once
// Measures the light that a matt surface throws back, and fits the normals of a coarse level to that of level 0. The
// mean over the surface is all that a wide blur leaves of its shading.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace defocus::engine {

// Unit vectors to the 26 neighbours in a cube; the second half is opposite to the first.
inline constexpr std::size_t lightCount = 26;
std::array<glm::dvec3, lightCount> directionsToLights();

// The mean radiance under a light of illuminance π, for each of the directions that it may come from. Nothing casts
// shadows, and a colour counts as the mean of its three channels.
using LightMeans = std::array<double, lightCount>;

// normalSpread() and meanCosine() of shaders/include/shading.glsl: the light that normals throw back whose mean is as
// long as `agreement` (in [0, 1]). `mean` is agreement · cosine for all normals alike; the mean of the result over all
// directions of the light is then 1/4.
inline float normalSpread(float agreement) {
    const float lost = 1 - agreement;
    const float root = std::sqrt(lost);
    return lost * (0.17796f + root * (1.04019f + root * (-1.37493f + root * (1.28514f - 0.72122f * root))));
}
inline float meanCosine(float mean, float cosine, float spread) {
    return 0.5f * (mean + std::sqrt(mean * mean + spread * std::max(1 - cosine * cosine, 0.0f)));
}

// The shaders bound interpolated agreements so.
inline constexpr float minShownAgreement = 0.05f;

// A surface with values at its vertices; `indices` are three a triangle.
struct LitSurface {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::vec4> colors;  // empty: white
    std::span<const std::uint32_t> indices;
    bool coarse = true;  // normals shorter than 1 stand for some that differ, as in shaders/include/shading.glsl
};

// Returns the light that a matt surface throws back, averaged over its area. Measured at three points of each triangle,
// or at more of them if these are fewer than `leastPoints` in all.
LightMeans lightMeans(const LitSurface& surface, std::size_t minPoints);

// Enough points for means that are right within 5e-4.
inline constexpr std::size_t pointsOfLight = 12'000;

// Turns the normals of a coarse surface until each light's mean is about `target`'s (within 5e-4, in the unit of the
// means, where few rounds of Levenberg 1944 and Marquardt 1963 find that); the change is the smallest in the mean
// square over the area, and no more than 16 times what it gains, since it shows at each point. Their lengths stay, so
// that no surface gets rougher or smoother. Vertices with equal numbers in `groups` (below positions.size()) share a
// normal, and keep it shared.
void fitLight(std::span<const glm::vec3> positions, std::span<const glm::vec4> colors,
              std::span<const std::uint32_t> indices, std::span<const std::uint32_t> groups, const LightMeans& target,
              std::span<glm::vec3> normals);

}  // namespace defocus::engine
