#pragma once
// Computes the light that a matt surface throws back, averaged over its area. Nothing else is left of its shading under
// a wide blur.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace defocus {

// Unit vectors to the 26 neighbours in a cube; the second half is opposite to the first.
inline constexpr std::size_t lightCount = 26;
std::array<glm::dvec3, lightCount> directionsToLights();

// The mean radiance under a light of illuminance π, for each of the directions that it may come from. Nothing casts
// shadows, and a colour counts as the mean of its three channels.
using LightMeans = std::array<double, lightCount>;

// A surface with values at its vertices; `indices` are three a triangle.
struct LitSurface {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::vec4> colors;  // empty: white
    std::span<const std::uint32_t> indices;
    bool coarse = true;  // normals shorter than 1 stand for some that differ, as in shaders/include/shading.glsl
};

// Measures at three points of each triangle, or at more of them if these are fewer than `leastPoints` in all.
LightMeans lightMeans(const LitSurface& surface, std::size_t leastPoints);

}  // namespace defocus
