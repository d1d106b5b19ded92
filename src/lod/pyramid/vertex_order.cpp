#include "lod/pyramid/vertex_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <span>
#include <utility>

namespace defocus::engine {

namespace {

// Vertices count as scattered if the mean difference between their indices, within a triangle and between consecutive
// triangles, exceeds this multiple of √(vertex count).
constexpr double maxSpread = 1.5;

}  // namespace

bool isScattered(const TriangleSet<MeshVertexNumber>& triangles, std::size_t vertexCount) {
    const std::span<const MeshVertexNumber> v = triangles.indices;
    const auto apart = [](MeshVertexNumber a, MeshVertexNumber b) {
        return a < b ? b.value - a.value : a.value - b.value;
    };
    std::uint64_t sum = 0;
    for (std::size_t i = 3; i < v.size(); ++i) sum += apart(v[i], v[i - 3]);
    for (std::size_t i = 0; i < v.size(); i += 3) sum += apart(v[i], v[i + 1]);
    // Number of differences in `sum`: one per index and one per triangle. The first triangle has fewer.
    const double differences = 4.0 / 3 * static_cast<double>(v.size());
    return static_cast<double>(sum) > maxSpread * std::sqrt(static_cast<double>(vertexCount)) * differences;
}

void sortSpatially(WeldedVertices& unique, const std::vector<glm::vec3>& positions) {
    if (unique.first.empty()) return;
    std::vector<glm::vec3> places;
    places.reserve(unique.first.size());
    for (const FileVertexNumber v : unique.first)
        places.push_back(isFinite(positions[v.value]) ? positions[v.value] : glm::vec3(0));
    std::vector<std::uint32_t> order(places.size());
    meshopt_spatialSortRemap(order.data(), &places[0].x, places.size(), sizeof(glm::vec3));
    for (MeshVertexNumber& id : unique.id) id = {order[id.value]};
    Numbered<MeshVertexNumber, FileVertexNumber> first(places.size());
    for (const MeshVertexNumber v : first.numbers()) first[{order[v.value]}] = unique.first[v];
    unique.first = std::move(first);
}

void sortSpatially(TriangleSet<MeshVertexNumber>& triangles) {
    std::size_t first = 0;
    std::vector<std::array<MeshVertexNumber, 4>> sorted;  // smallest vertex index of a triangle, then its corners
    for (const std::uint32_t count : triangles.primitiveIndexCounts) {
        MeshVertexNumber* const indices = triangles.indices.data() + first;
        sorted.clear();
        for (std::size_t i = 0; i < count; i += 3)
            sorted.push_back(
                {std::min({indices[i], indices[i + 1], indices[i + 2]}), indices[i], indices[i + 1], indices[i + 2]});
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
        for (std::size_t t = 0; t < sorted.size(); ++t) std::copy_n(sorted[t].begin() + 1, 3, indices + 3 * t);
        first += count;
    }
}

SurvivalOrder sortBySurvival(const std::vector<TriangleSet<MeshVertexNumber>>& levels,
                             const WeldedPositions& positions) {
    // For each position, a linked list of its vertices that any level uses; `head` holds the first vertex of each list.
    const std::size_t vertexCount = positions.id.size();
    Numbered<MeshVertexNumber, std::uint8_t> used(vertexCount, 0);
    for (const TriangleSet<MeshVertexNumber>& level : levels)
        for (const MeshVertexNumber v : level.indices) used[v] = 1;
    Numbered<PositionNumber, MeshVertexNumber> head(positions.first.size());
    Numbered<MeshVertexNumber, MeshVertexNumber> next(vertexCount);
    for (const MeshVertexNumber v : std::views::reverse(next.numbers())) {
        if (used[v] == 0) continue;
        next[v] = head[positions.id[v]];
        head[positions.id[v]] = v;
    }

    // From the coarsest level to the finest, append the vertices at positions that no coarser level uses.
    SurvivalOrder order;
    order.vertexCounts.resize(levels.size());
    order.numbers.resize(vertexCount);
    for (std::size_t l = levels.size(); l-- > 0;) {
        for (const MeshVertexNumber v : levels[l].indices) {
            if (order.numbers[v].isValid()) continue;
            for (MeshVertexNumber w = head[positions.id[v]]; w.isValid(); w = next[w]) {
                order.numbers[w] = order.vertices.next();
                order.vertices.push_back(w);
            }
        }
        order.vertexCounts[l] = static_cast<std::uint32_t>(order.vertices.size());
    }
    return order;
}

}  // namespace defocus::engine
