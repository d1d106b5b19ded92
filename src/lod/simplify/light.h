#pragma once
// Measures the mean radiance that a matt surface reflects, and fits the normals of a coarse level so that its mean
// radiance equals that of level 0. A wide blur reduces shading to this mean over the surface.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace defocus::engine {

// Directions to the lights: unit vectors from the centre cell of a 3 × 3 × 3 cube to the 26 other cells. Each vector of
// the second half is opposite to one of the first half.
inline constexpr std::size_t lightCount = 26;
std::array<glm::dvec3, lightCount> directionsToLights();

// For each light direction, the mean radiance that a surface reflects under a light of illuminance π. Shadows are
// ignored. Colours are averaged over their three channels.
using LightMeans = std::array<double, lightCount>;

// normalSpread() returns the spread of a distribution of normals. meanCosine() returns the mean clamped cosine between
// the normals and a light direction. Both match shaders/include/shading.glsl. `agreement`, in [0, 1], is the length of
// the mean of the unit normals. `cosine` is the cosine of the angle between mean normal and light direction. `mean` is
// the mean cosine without clamping. It is agreement · cosine if the distribution is symmetric about the mean normal;
// in this case, the average of meanCosine() over all light directions is 1/4.
inline float normalSpread(float agreement) {
    const float lost = 1 - agreement;
    const float root = std::sqrt(lost);
    return lost * (0.17796f + root * (1.04019f + root * (-1.37493f + root * (1.28514f - 0.72122f * root))));
}
inline float meanCosine(float mean, float cosine, float spread) {
    return 0.5f * (mean + std::sqrt(mean * mean + spread * std::max(1 - cosine * cosine, 0.0f)));
}

// Lower bound on the interpolated length of a mean normal; the shaders use the same bound.
inline constexpr float minShownAgreement = 0.05f;

// A surface with vertex attributes; three indices form a triangle.
struct LitSurface {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::vec4> colors;  // vertex colours; empty: white
    std::span<const std::uint32_t> indices;
    bool coarse = true;  // coarse level: a normal shorter than 1 represents diverging normals (shading.glsl)
};

// Returns the mean radiance that a matt surface reflects under each light. Samples at least three points per triangle
// and at least `minPoints` points in total.
LightMeans lightMeans(const LitSurface& surface, std::size_t minPoints);

// Number of sample points with which lightMeans() has an error of at most 5e-4.
inline constexpr std::size_t pointsOfLight = 12'000;

// Rotates the normals of a coarse surface until the mean radiance under each light is within 5e-4 of `target`. Uses a
// few rounds of the Levenberg–Marquardt method (Levenberg 1944, Marquardt 1963), which may end before this accuracy is
// reached. Among the possible rotations, it selects those with the smallest RMS change of the normals, weighted by
// area. Under a narrow blur, the rotation changes the shading visibly at each point. The RMS change is therefore
// limited to 16 times the amount by which it reduces the largest error of the mean radiances. Lengths of normals are
// preserved, so that roughness does not change. Vertices with equal values in `groups` share a normal, on entry and on
// return. Group numbers are below positions.size().
void fitLight(std::span<const glm::vec3> positions, std::span<const glm::vec4> colors,
              std::span<const std::uint32_t> indices, std::span<const std::uint32_t> groups, const LightMeans& target,
              std::span<glm::vec3> normals);

}  // namespace defocus::engine
