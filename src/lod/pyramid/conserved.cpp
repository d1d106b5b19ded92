#include "lod/pyramid/conserved.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lod/simplify/triangle.h"

namespace defocus {

namespace {

constexpr float leastTurnedAgreement = 0.05f;  // as the shaders bound it

// The lights' directions, coordinate by coordinate, which compilers compute with several at once.
struct Lights {
    std::array<float, lightCount> x, y, z;
};

Lights lights() {
    Lights result;
    const auto directions = directionsToLights();
    for (std::size_t l = 0; l < lightCount; ++l) {
        result.x[l] = static_cast<float>(directions[l].x);
        result.y[l] = static_cast<float>(directions[l].y);
        result.z[l] = static_cast<float>(directions[l].z);
    }
    return result;
}

using LightRow = std::array<float, lightCount>;

// meanCosine() of shaders/include/shading.glsl under each light.
void mattCosines(const Lights& lights, const glm::vec3& normal, float agreement, LightRow& result) {
    const float spread = std::numbers::inv_pi_v<float> * (1 - agreement * agreement);
    for (std::size_t l = 0; l < lightCount; ++l) {
        const float cosine = normal.x * lights.x[l] + normal.y * lights.y[l] + normal.z * lights.z[l];
        const float mean = agreement * cosine;
        result[l] = 0.5f * (mean + std::sqrt(mean * mean + spread * std::max(1 - cosine * cosine, 0.0f)));
    }
}

struct LitPoint {
    glm::vec3 normal{0};  // unit length, or 0
    float agreement = 1;
    float weight = 0;  // area times colour
};

// Visits points of the surface; its area.
template <typename Visit>
double forEachLitPoint(const LitSurface& surface, std::size_t leastPoints, const Visit& visit) {
    const std::size_t triangles = surface.indices.size() / 3;
    const double wanted = std::sqrt(static_cast<double>(leastPoints) / static_cast<double>(3 * triangles + 1));
    const int parts = std::max(1, static_cast<int>(std::ceil(wanted)));
    double areas = 0;
    for (std::size_t i = 0; i < 3 * triangles; i += 3) {
        const std::uint32_t* const v = &surface.indices[i];
        const glm::dvec3 a = surface.positions[v[0]];
        const double area = 0.5 * glm::length(glm::cross(glm::dvec3(surface.positions[v[1]]) - a,
                                                         glm::dvec3(surface.positions[v[2]]) - a));
        if (!(area > 0) || !std::isfinite(area)) continue;
        areas += area;
        float lengths[3];
        float colors[3];
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] = surface.coarse ? glm::length(surface.normals[v[k]]) : 1;
            const glm::vec4 color = surface.colors.empty() ? glm::vec4(1) : surface.colors[v[k]];
            colors[k] = (color.r + color.g + color.b) / 3;
        }
        forEachTrianglePoint(parts, [&](const glm::dvec3& at, double share) {
            const glm::vec3 w(at);
            const glm::vec3 normal =
                w.x * surface.normals[v[0]] + w.y * surface.normals[v[1]] + w.z * surface.normals[v[2]];
            const float length = glm::length(normal);
            LitPoint point;
            if (length > 0) point.normal = normal / length;
            point.agreement =
                std::clamp(w.x * lengths[0] + w.y * lengths[1] + w.z * lengths[2], leastTurnedAgreement, 1.0f);
            point.weight = static_cast<float>(share * area) * (w.x * colors[0] + w.y * colors[1] + w.z * colors[2]);
            visit(point);
        });
    }
    return areas;
}

}  // namespace

std::array<glm::dvec3, lightCount> directionsToLights() {
    std::array<glm::dvec3, lightCount> directions;
    for (int i = 0; i < 13; ++i) {
        const auto d = static_cast<std::size_t>(i);
        directions[d] = glm::normalize(glm::dvec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
        directions[d + 13] = -directions[d];
    }
    return directions;
}

LightMeans lightMeans(const LitSurface& surface, std::size_t leastPoints) {
    const Lights from = lights();
    LightMeans means{};
    LightRow cosines;
    const double area = forEachLitPoint(surface, leastPoints, [&](const LitPoint& point) {
        mattCosines(from, point.normal, surface.coarse ? point.agreement : 1, cosines);
        for (std::size_t l = 0; l < lightCount; ++l) means[l] += double{point.weight * cosines[l]};
    });
    for (double& mean : means) mean = area > 0 ? mean / area : 0;
    return means;
}

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

}  // namespace defocus
