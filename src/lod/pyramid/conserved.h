#pragma once
// Measures the properties of a surface that a wide blur preserves: mean colour, reflected radiance and covered area.
// Their differences show how far a level of detail deviates from level 0, the full mesh.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "lod/pyramid/pyramid.h"
#include "lod/simplify/light.h"
#include "lod/simplify/outline.h"

namespace defocus::engine {

struct Conserved {
    double area = 0;       // surface area, object units squared
    glm::dvec3 colour{0};  // area-weighted mean colour
    LightMeans light{};    // mean reflected radiance for each light direction; textures are ignored
    // Area of the surface's silhouette in parallel projection along each direction, in object units squared. Opposite
    // directions give the same area.
    std::array<double, outlineDirections> outline{};
};

// Returns the colour of a surface at a point of a triangle. `firstIndex` is the offset of the triangle's first index in
// Pyramid::indices; `weights` are the point's barycentric coordinates.
using ColourAt = std::function<glm::dvec3(std::uint32_t firstIndex, const glm::dvec3& weights)>;

// Returns a function that interpolates the level's vertex colours, or returns white if the level has none.
ColourAt vertexColours(const Pyramid& pyramid, std::size_t level);

// Measures the conserved properties of a level. Colour and reflected radiance are sampled at `points` or more points;
// silhouettes are rasterized on a grid of `resolution`² points. The mean colour is exact if the colour is linear over
// each triangle.
Conserved conservedBy(const Pyramid& pyramid, std::size_t level, const ColourAt& colour, std::size_t points,
                      int resolution);

// Differences between a level and level 0 in the properties that Conserved holds.
struct ConservedDifference {
    double colour = 0;       // max difference between the mean colours, over all channels
    double light = 0;        // max difference between the mean reflected radiances, over all light directions
    double outline = 0;      // max relative difference between the silhouette areas, over all view directions
    double meanOutline = 0;  // signed relative difference between the silhouette areas' means over all view directions
};

ConservedDifference differenceOf(const Conserved& level, const Conserved& level0);

}  // namespace defocus::engine
