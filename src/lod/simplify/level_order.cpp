#include "lod/simplify/level_order.h"

#include <algorithm>

namespace defocus {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

}  // namespace

SurvivalOrder sortBySurvival(std::vector<TriangleSet>& levels, const Welded& positions) {
    // The vertices of each position, in a list that starts at `head`; only those that a level uses.
    const std::size_t vertexCount = positions.id.size();
    std::vector<std::uint8_t> used(vertexCount, 0);
    for (const TriangleSet& level : levels)
        for (const std::uint32_t v : level.indices) used[v] = 1;
    std::vector<std::uint32_t> head(positions.first.size(), none);
    std::vector<std::uint32_t> next(vertexCount, none);
    for (std::size_t v = vertexCount; v-- > 0;) {
        if (used[v] == 0) continue;
        next[v] = head[positions.id[v]];
        head[positions.id[v]] = static_cast<std::uint32_t>(v);
    }

    // From the coarsest level to the finest: each adds the positions that no coarser one uses.
    SurvivalOrder order;
    order.vertexCounts.resize(levels.size());
    std::vector<std::uint32_t> newNumber(vertexCount, none);
    for (std::size_t l = levels.size(); l-- > 0;) {
        for (const std::uint32_t v : levels[l].indices) {
            if (newNumber[v] != none) continue;
            for (std::uint32_t w = head[positions.id[v]]; w != none; w = next[w]) {
                newNumber[w] = static_cast<std::uint32_t>(order.vertices.size());
                order.vertices.push_back(w);
            }
        }
        order.vertexCounts[l] = static_cast<std::uint32_t>(order.vertices.size());
    }
    for (TriangleSet& level : levels)
        for (std::uint32_t& v : level.indices) v = newNumber[v];
    return order;
}

}  // namespace defocus
