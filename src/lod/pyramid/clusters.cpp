#include "lod/pyramid/clusters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/bounds.h"
#include "lod/pyramid/cluster_growth.h"

namespace defocus {

namespace {

constexpr std::uint32_t unnumbered = 0xffffffffu;
// What single precision may lose of a stored value, relative to the size of what it was computed from.
constexpr double valueRounding = 1e-6;

// 0 for what is no place at all.
glm::vec3 finitePosition(const glm::vec3& position) {
    return isFinite(position) ? position : glm::vec3(0);
}

// A primitive's triangles with places numbered from 0: its cost shall not depend on the whole mesh.
struct LocalTriangles {
    std::vector<std::uint32_t> corners;  // their places
    std::vector<glm::vec3> positions;    // of places
};

LocalTriangles localTriangles(std::span<const std::uint32_t> indices, const std::vector<glm::vec3>& positions,
                              std::span<const std::uint32_t> places, std::vector<std::uint32_t>& localOf) {
    LocalTriangles local;
    local.corners.reserve(indices.size());
    for (const std::uint32_t v : indices) {
        std::uint32_t& number = localOf[places[v]];
        if (number == unnumbered) {
            number = static_cast<std::uint32_t>(local.positions.size());
            local.positions.push_back(finitePosition(positions[v]));
        }
        local.corners.push_back(number);
    }
    for (const std::uint32_t v : indices) localOf[places[v]] = unnumbered;
    return local;
}

struct ClusterTriangle {
    glm::dvec3 p[3];
    glm::dvec3 cross;
    [[nodiscard]] bool collapsed() const { return p[0] == p[1] || p[1] == p[2] || p[2] == p[0]; }
    [[nodiscard]] double longestEdge() const {
        const auto squared = [](const glm::dvec3& e) { return glm::dot(e, e); };
        return std::sqrt(std::max({squared(p[1] - p[0]), squared(p[2] - p[1]), squared(p[0] - p[2])}));
    }
};

Cluster measured(std::span<const std::uint32_t> indices, const std::vector<glm::vec3>& positions) {
    std::vector<ClusterTriangle> triangles(indices.size() / 3);
    glm::vec3 least = finitePosition(positions[indices.front()]);
    glm::vec3 most = least;
    glm::dvec3 sum(0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        ClusterTriangle& triangle = triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = finitePosition(positions[indices[3 * t + k]]);
            least = glm::min(least, p);
            most = glm::max(most, p);
            triangle.p[k] = glm::dvec3(p);
        }
        triangle.cross = glm::cross(triangle.p[1] - triangle.p[0], triangle.p[2] - triangle.p[0]);
        sum += triangle.cross;
    }

    // The ball, and the cone of normals about their mean by area.
    Cluster cluster;
    cluster.centre = glm::vec3(0.5 * (glm::dvec3(least) + glm::dvec3(most)));
    const glm::dvec3 centre(cluster.centre);
    if (glm::length(sum) > 0) cluster.axis = glm::vec3(glm::normalize(sum));
    const glm::dvec3 axis(cluster.axis);
    double squaredRadius = 0;
    double leastCosine = 1;
    double planes = std::numeric_limits<double>::infinity();
    double altitude = std::numeric_limits<double>::infinity();
    for (const ClusterTriangle& triangle : triangles) {
        for (const glm::dvec3& p : triangle.p)
            squaredRadius = std::max(squaredRadius, glm::dot(p - centre, p - centre));
        if (triangle.collapsed()) continue;
        const double area2 = glm::length(triangle.cross);
        altitude = std::min(altitude, area2 / triangle.longestEdge());
        if (!(area2 > 0)) continue;
        const glm::dvec3 normal = triangle.cross / area2;
        leastCosine = std::min(leastCosine, glm::dot(normal, axis));
        planes = std::min(planes, glm::dot(normal, triangle.p[0] - centre));
    }
    const double radius = std::sqrt(squaredRadius);
    cluster.radius = static_cast<float>(radius * (1 + valueRounding));
    cluster.leastCosine = static_cast<float>(leastCosine - valueRounding);
    cluster.planes = static_cast<float>(std::max(planes, -radius) - valueRounding * radius);
    cluster.leastAltitude = std::isfinite(altitude) ? static_cast<float>(altitude * (1 - valueRounding)) : 0;
    return cluster;
}

// Orders the triangles of a primitive, the first of whose indices is the level's `first`.
void clusterPrimitive(std::span<std::uint32_t> indices, const std::vector<glm::vec3>& positions,
                      const LocalTriangles& local, std::uint32_t first, std::vector<Cluster>& result) {
    const GrownClusters grown = growClusters(local.corners, local.positions, mostClusterTriangles);
    const std::vector<std::uint32_t> unordered(indices.begin(), indices.end());
    for (std::size_t t = 0; t < grown.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) indices[3 * t + k] = unordered[3 * std::size_t{grown.triangles[t]} + k];
    for (const std::uint32_t size : grown.sizes) {
        result.push_back(measured(indices.first(3 * std::size_t{size}), positions));
        result.back().indices = {first, 3 * size};
        indices = indices.subspan(3 * std::size_t{size});
        first += 3 * size;
    }
}

}  // namespace

std::vector<Cluster> clusterTriangles(TriangleSet& level, const std::vector<glm::vec3>& positions,
                                      std::span<const std::uint32_t> places, std::size_t placeCount) {
    std::vector<Cluster> result;
    result.reserve(level.indices.size() / (3 * mostClusterTriangles) + level.primitiveIndexCounts.size());
    std::vector<std::uint32_t> localOf(placeCount, unnumbered);
    std::uint32_t first = 0;
    for (const std::uint32_t count : level.primitiveIndexCounts) {
        if (count == 0) continue;
        const std::span<std::uint32_t> indices = std::span(level.indices).subspan(first, count);
        clusterPrimitive(indices, positions, localTriangles(indices, positions, places, localOf), first, result);
        first += count;
    }
    return result;
}

}  // namespace defocus
