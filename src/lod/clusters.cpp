#include "lod/clusters.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/bounds.h"
#include "core/memory.h"

namespace defocus {

namespace {

constexpr std::uint32_t unnumbered = 0xffffffffu;
constexpr std::size_t mostClusterVertices = 128;
constexpr float coneWeight = 0.75f;  // of likeness of normals against compactness
// What single precision may lose of a stored value, relative to the size of what it was computed from.
constexpr double valueRounding = 1e-6;

// A primitive's triangles with vertices numbered from 0: its cost shall not depend on the whole mesh.
struct LocalTriangles {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> vertices;  // the level's number of each
    std::vector<glm::vec3> positions;     // of them; 0 for what is no number
};

LocalTriangles localTriangles(const std::uint32_t* indices, std::size_t count, const std::vector<glm::vec3>& positions,
                              std::vector<std::uint32_t>& localOf) {
    LocalTriangles local;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t v = indices[i];
        if (localOf[v] == unnumbered) {
            localOf[v] = static_cast<std::uint32_t>(local.vertices.size());
            local.vertices.push_back(v);
            local.positions.push_back(isFinite(positions[v]) ? positions[v] : glm::vec3(0));
        }
        local.indices.push_back(localOf[v]);
    }
    for (const std::uint32_t v : local.vertices) localOf[v] = unnumbered;
    return local;
}

struct Meshlets {
    LargeVector<meshopt_Meshlet> list;
    LargeVector<std::uint32_t> vertices;
    LargeVector<unsigned char> corners;
};

Meshlets meshlets(const LocalTriangles& local) {
    const std::size_t most =
        meshopt_buildMeshletsBound(local.indices.size(), mostClusterVertices, mostClusterTriangles);
    Meshlets result;
    result.list.resize(most);
    result.vertices.resize(most * mostClusterVertices);
    result.corners.resize(most * mostClusterTriangles * 3);
    result.list.resize(meshopt_buildMeshlets(result.list.data(), result.vertices.data(), result.corners.data(),
                                             local.indices.data(), local.indices.size(), &local.positions.front().x,
                                             local.positions.size(), sizeof(glm::vec3), mostClusterVertices,
                                             mostClusterTriangles, coneWeight));
    return result;
}

// The corners of one, in an order that suits the vertex cache.
void orderCorners(const Meshlets& all, const meshopt_Meshlet& meshlet, std::vector<std::uint32_t>& corners) {
    const std::size_t count = std::size_t{meshlet.triangle_count} * 3;
    const unsigned char* const own = all.corners.data() + meshlet.triangle_offset;
    corners.assign(own, own + count);
    meshopt_optimizeVertexCache(corners.data(), corners.data(), count, meshlet.vertex_count);
    for (std::uint32_t& corner : corners) corner = all.vertices[meshlet.vertex_offset + corner];
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

Cluster measured(const std::vector<std::uint32_t>& indices, const std::vector<glm::vec3>& positions) {
    std::vector<ClusterTriangle> triangles(indices.size() / 3);
    Bounds box;
    glm::dvec3 sum(0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        ClusterTriangle& triangle = triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.p[k] = glm::dvec3(positions[indices[3 * t + k]]);
            box.extend(triangle.p[k]);
        }
        triangle.cross = glm::cross(triangle.p[1] - triangle.p[0], triangle.p[2] - triangle.p[0]);
        sum += triangle.cross;
    }

    // The ball, and the cone of normals about their mean by area.
    Cluster cluster;
    if (box.empty()) return cluster;
    cluster.centre = glm::vec3(box.centre());
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

}  // namespace

std::vector<Cluster> clusterTriangles(LevelTriangles& level, const std::vector<glm::vec3>& positions) {
    std::vector<Cluster> result;
    std::vector<std::uint32_t> localOf(positions.size(), unnumbered);
    std::vector<std::uint32_t> corners;
    std::uint32_t first = 0;
    for (const std::uint32_t count : level.primitiveIndexCounts) {
        if (count == 0) continue;
        const LocalTriangles local = localTriangles(level.indices.data() + first, count, positions, localOf);
        const Meshlets all = meshlets(local);
        for (const meshopt_Meshlet& meshlet : all.list) {
            orderCorners(all, meshlet, corners);
            Cluster& cluster = result.emplace_back(measured(corners, local.positions));
            cluster.indices = {first, static_cast<std::uint32_t>(corners.size())};
            for (const std::uint32_t v : corners) level.indices[first++] = local.vertices[v];
        }
    }
    return result;
}

}  // namespace defocus
