#pragma once
// Measures what a blur leaves of a surface, so that a level can be compared with level 0: its mean colour, the light it
// throws back, and the area it covers.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/outline.h"

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

// Returns the light that a matt surface throws back, averaged over its area: all that a wide blur leaves of its
// shading. Measured at three points of each triangle, or at more of them if these are fewer than `leastPoints` in all.
LightMeans lightMeans(const LitSurface& surface, std::size_t leastPoints);

struct Conserved {
    double area = 0;       // object units squared
    glm::dvec3 colour{0};  // mean over the area
    LightMeans light{};    // of vertex colours alone
    // What the surface covers, seen along each direction and from either side, in object units squared. It is the same
    // from the opposite direction.
    std::array<double, outlineDirections> outline{};
};

// Returns the colour of a surface at a point: on the triangle that begins at `firstIndex` in Pyramid::indices, at the
// barycentric coordinates `weights`.
using ColourAt = std::function<glm::dvec3(std::uint32_t firstIndex, const glm::dvec3& weights)>;

// Returns the level's interpolated vertex colours; white if it has none.
ColourAt vertexColours(const Pyramid& pyramid, std::size_t level);

// Measures a level with at least `points` points over its area for colour and light, and on a grid of `resolution`²
// points for the outline. The colour is exact where it is linear over each triangle.
Conserved conservedBy(const Pyramid& pyramid, std::size_t level, const ColourAt& colour, std::size_t points,
                      int resolution);

// The largest differences of these values between a level and level 0.
struct ConservedDifference {
    double colour = 0;       // of a channel
    double light = 0;        // of a light
    double outline = 0;      // relative, of a direction
    double meanOutline = 0;  // relative, signed: of the mean over directions
};

ConservedDifference differenceOf(const Conserved& level, const Conserved& level0);

}  // namespace defocus
