#pragma once
// The light that a matt surface throws back, in the mean over its area: what is left of its shading under a wide blur.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace defocus {

// Unit vectors to the 26 neighbours in a cube; the second half is opposite to the first.
inline constexpr std::size_t lightCount = 26;
std::array<glm::dvec3, lightCount> directionsToLights();

// Mean radiance under a light of illuminance π from each direction, one after the other: nothing shades anything, and
// of colours the mean of the three channels counts.
using LightMeans = std::array<double, lightCount>;

// A surface with values at its vertices; `indices` are three a triangle.
struct LitSurface {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::vec4> colors;  // empty: white
    std::span<const std::uint32_t> indices;
    bool coarse = true;  // normals shorter than 1 stand for some that differ, as in shaders/include/shading.glsl
};

// Measured at three points a triangle, or more where there are fewer than `leastPoints` of them.
LightMeans lightMeans(const LitSurface& surface, std::size_t leastPoints);

}  // namespace defocus
