#include "lod/level_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace defocus {

namespace {

constexpr float agreeingCosine = 0.99985f;  // 1°

}  // namespace

std::vector<std::uint32_t> smoothingGroups(const std::vector<glm::vec3>& normals,
                                           const std::vector<std::uint32_t>& positions) {
    std::vector<std::uint32_t> order(normals.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return positions[a] < positions[b]; });

    std::vector<std::uint32_t> groups(normals.size());
    std::vector<std::uint32_t> leaders;  // the first vertex of each group at this position
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || positions[order[i]] != positions[order[i - 1]]) leaders.clear();
        const glm::vec3& normal = normals[order[i]];
        const auto leader = std::find_if(leaders.begin(), leaders.end(), [&](std::uint32_t v) {
            return glm::dot(normals[v], normal) > agreeingCosine;
        });
        groups[order[i]] = leader != leaders.end() ? *leader : order[i];
        if (leader == leaders.end()) leaders.push_back(order[i]);
    }
    return groups;
}

std::vector<glm::vec3> levelNormals(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& original,
                                    const std::vector<std::uint32_t>& groups, std::span<const std::uint32_t> indices,
                                    std::uint32_t vertexCount) {
    // A group's leader may lie anywhere among the vertices.
    std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t* v = &indices[i];
        const glm::dvec3 a = points[v[0]];
        glm::dvec3 cross = glm::cross(glm::dvec3(points[v[1]]) - a, glm::dvec3(points[v[2]]) - a);
        if (glm::dot(cross, glm::dvec3(original[v[0]] + original[v[1]] + original[v[2]])) < 0) cross = -cross;
        for (std::size_t corner = 0; corner < 3; ++corner) sums[groups[v[corner]]] += cross;
    }

    std::vector<glm::vec3> normals(vertexCount);
    for (std::uint32_t v = 0; v < vertexCount; ++v) {
        const glm::dvec3& sum = sums[groups[v]];
        const double length = glm::length(sum);
        normals[v] = length > 0 && std::isfinite(length) ? glm::vec3(sum / length) : original[v];
    }
    return normals;
}

}  // namespace defocus
