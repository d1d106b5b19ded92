#include "lod/level_order.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace defocus {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

}  // namespace

void optimizeTriangleOrder(LevelTriangles& level, std::size_t vertexCount) {
    std::vector<std::uint32_t> localOf(vertexCount, none);
    std::vector<std::uint32_t>
        vertices;  // of the primitive, numbered from 0: its cost shall not depend on the whole mesh
    std::vector<std::uint32_t> local;
    std::size_t first = 0;
    for (const std::uint32_t count : level.primitiveIndexCounts) {
        vertices.clear();
        local.assign(level.indices.begin() + static_cast<std::ptrdiff_t>(first),
                     level.indices.begin() + static_cast<std::ptrdiff_t>(first + count));
        for (std::uint32_t& v : local) {
            if (localOf[v] == none) {
                localOf[v] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(v);
            }
            v = localOf[v];
        }
        if (count > 0) meshopt_optimizeVertexCache(local.data(), local.data(), count, vertices.size());
        for (std::size_t i = 0; i < count; ++i) level.indices[first + i] = vertices[local[i]];
        for (const std::uint32_t v : vertices) localOf[v] = none;
        first += count;
    }
}

SurvivalOrder sortBySurvival(std::vector<LevelTriangles>& levels, const Welded& positions) {
    // The vertices of each position, in a list that starts at `head`; only those that a level uses.
    const std::size_t vertexCount = positions.id.size();
    std::vector<std::uint8_t> used(vertexCount, 0);
    for (const LevelTriangles& level : levels)
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
    for (LevelTriangles& level : levels)
        for (std::uint32_t& v : level.indices) v = newNumber[v];
    return order;
}

}  // namespace defocus
