#include "lod/simplify/smoothing_groups.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace defocus {

namespace {

constexpr float agreeingCosine = 0.99985f;  // 1°

}  // namespace

std::vector<std::uint32_t> smoothingGroups(const std::vector<glm::vec3>& normals,
                                           const std::vector<std::uint32_t>& positions) {
    // Only vertices that share their position with another need a look; the others lead themselves.
    std::vector<std::uint32_t> groups(normals.size());
    std::iota(groups.begin(), groups.end(), 0u);
    const std::size_t positionCount =
        positions.empty() ? 0 : std::size_t{1} + *std::max_element(positions.begin(), positions.end());
    std::vector<std::uint8_t> met(positionCount, 0);  // how many vertices are there, up to 2
    for (const std::uint32_t position : positions) met[position] = met[position] == 0 ? 1 : 2;
    std::vector<std::uint32_t> order;
    for (const std::uint32_t v : groups)
        if (met[positions[v]] == 2) order.push_back(v);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return positions[a] < positions[b]; });

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
