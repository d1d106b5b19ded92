#include "lod/pyramid/conserved.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "lod/simplify/triangle.h"

namespace defocus::engine {

ColourAt vertexColours(const Pyramid& pyramid, std::size_t level) {
    const std::vector<glm::vec4>& colours = pyramid.levels[level].colors;
    if (colours.empty()) return [](std::uint32_t, const glm::dvec3&) { return glm::dvec3(1); };
    return [&pyramid, &colours](std::uint32_t firstIndex, const glm::dvec3& weights) {
        glm::dvec3 sum(0);
        for (std::uint32_t k = 0; k < 3; ++k)
            sum += weights[static_cast<glm::length_t>(k)] * glm::dvec3(colours[pyramid.indices[firstIndex + k]]);
        return sum;
    };
}

Conserved conservedBy(const Pyramid& pyramid, std::size_t level, const ColourAt& colour, std::size_t points,
                      int resolution) {
    const PyramidLevel& own = pyramid.levels[level];
    const auto directions = directionsOfOutlines();
    const auto first = own.primitives.empty() ? 0u : own.primitives.front().first;
    const std::span<const std::uint32_t> indices(pyramid.indices.data() + first, 3 * std::size_t{own.triangleCount});
    const auto crossOf = [&](std::size_t i) {
        const glm::dvec3 a = own.positions[indices[i]];
        return glm::cross(glm::dvec3(own.positions[indices[i + 1]]) - a, glm::dvec3(own.positions[indices[i + 2]]) - a);
    };

    Conserved result;
    for (std::size_t i = 0; i < indices.size(); i += 3) result.area += 0.5 * glm::length(crossOf(i));
    const double pointsPerArea = static_cast<double>(points) / (3 * result.area);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const double area = 0.5 * glm::length(crossOf(i));
        if (!(area > 0)) continue;
        const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt(area * pointsPerArea))));
        forEachTrianglePoint(parts, [&](const glm::dvec3& weights, double share) {
            share *= area / result.area;
            result.colour += share * colour(first + static_cast<std::uint32_t>(i), weights);
        });
    }
    result.light = lightMeans({own.positions, own.normals, own.colors, indices, level > 0}, points);
    for (std::size_t d = 0; d < result.outline.size(); ++d) {
        CoverGrid grid(pyramid.bounds, directions[d], resolution);
        grid.add(own.positions, indices);
        result.outline[d] = grid.area();
    }
    return result;
}

ConservedDifference differenceOf(const Conserved& level, const Conserved& level0) {
    ConservedDifference difference;
    for (glm::length_t c = 0; c < 3; ++c)
        difference.colour = std::max(difference.colour, std::abs(level.colour[c] - level0.colour[c]));
    for (std::size_t i = 0; i < level.light.size(); ++i)
        difference.light = std::max(difference.light, std::abs(level.light[i] - level0.light[i]));
    double sum = 0;
    double sum0 = 0;
    for (std::size_t d = 0; d < level.outline.size(); ++d) {
        sum += level.outline[d];
        sum0 += level0.outline[d];
        if (level0.outline[d] > 0)
            difference.outline = std::max(difference.outline, std::abs(level.outline[d] / level0.outline[d] - 1));
    }
    if (sum0 > 0) difference.meanOutline = sum / sum0 - 1;
    return difference;
}

}  // namespace defocus::engine
