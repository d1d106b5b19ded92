#include "lod/smoothing_groups.h"

#include <algorithm>
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

}  // namespace defocus
