#pragma once
// Measures what a blur leaves of a surface, so that a level can be compared with level 0: its mean colour, the light it
// throws back, and the area it covers.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/light.h"
#include "lod/simplify/outline.h"

namespace defocus::engine {

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

}  // namespace defocus::engine
