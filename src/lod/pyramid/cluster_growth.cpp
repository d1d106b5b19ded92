#include "lod/pyramid/cluster_growth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "core/memory.h"

namespace defocus {

namespace {

constexpr float coneWeight = 0.75f;     // of likeness of normals against compactness
constexpr float leastTurn = 1e-3f;      // what the price of a normal doesn't fall below
constexpr std::size_t seedsAhead = 64;  // triangles beside earlier clusters that are looked at for a seed
constexpr std::uint32_t noTriangle = 0xffffffffu;
constexpr std::uint32_t noCluster = 0xffffffffu;

struct Facet {
    glm::vec3 centre{0};
    glm::vec3 normal{0};  // unit length; zero without area
};

// The clusters so far, and the one that grows.
struct ClusterGrowth {
    std::span<const std::uint32_t> corners;
    LargeVector<Facet> facets;
    float radius = 0;  // that a full cluster would have on a flat, even surface

    std::vector<std::uint32_t> first;        // of each vertex, into `around`
    LargeVector<std::uint32_t> around;       // the triangles at each vertex
    std::vector<std::uint32_t> open;         // of each vertex: corners of triangles that are in no cluster yet
    std::vector<std::uint32_t> lastCluster;  // of each vertex, that it is in
    std::vector<std::uint8_t> taken;         // of each triangle

    // The one that grows: sums over its triangles, …
    std::uint32_t size = 0;
    glm::vec3 centres{0};
    glm::vec3 normals{0};
    // … and the triangles that touch it. They may have been taken since.
    std::vector<std::uint32_t> closed;    // all three corners are in it
    std::vector<std::uint32_t> hanging;   // the last one open at a vertex: alone it would be dear to draw
    std::vector<std::uint32_t> beside;    // two corners are in it
    std::vector<std::uint32_t> touching;  // one is
    std::vector<std::uint32_t> left;      // those of earlier clusters
    std::uint32_t unseen = 0;             // all triangles before it have been taken

    GrownClusters result;
};

void measureFacets(ClusterGrowth& g, std::span<const glm::vec3> positions, std::uint32_t most) {
    const std::size_t count = g.corners.size() / 3;
    g.facets.reserve(count);
    double area = 0;
    for (std::size_t t = 0; t < count; ++t) {
        const glm::vec3& a = positions[g.corners[3 * t]];
        const glm::vec3& b = positions[g.corners[3 * t + 1]];
        const glm::vec3& c = positions[g.corners[3 * t + 2]];
        const glm::vec3 cross = glm::cross(b - a, c - a);
        const float doubleArea = glm::length(cross);
        g.facets.push_back({(a + b + c) / 3.0f, doubleArea > 0 ? cross / doubleArea : glm::vec3(0)});
        area += 0.5 * double{doubleArea};
    }
    g.radius = static_cast<float>(0.5 * std::sqrt(area / static_cast<double>(count) * most));
}

void connect(ClusterGrowth& g, std::size_t vertexCount) {
    g.first.assign(vertexCount + 1, 0);
    for (const std::uint32_t v : g.corners) ++g.first[v + 1];
    g.open.assign(g.first.begin() + 1, g.first.end());
    std::partial_sum(g.first.begin(), g.first.end(), g.first.begin());
    g.around.resize(g.corners.size());
    std::vector<std::uint32_t> next(g.first.begin(), g.first.end() - 1);
    for (std::size_t c = 0; c < g.corners.size(); ++c)
        g.around[next[g.corners[c]]++] = static_cast<std::uint32_t>(c / 3);
    g.lastCluster.assign(vertexCount, noCluster);
    g.taken.assign(g.corners.size() / 3, 0);
}

std::span<const std::uint32_t> trianglesAround(const ClusterGrowth& g, std::uint32_t v) {
    return std::span(g.around).subspan(g.first[v], g.first[v + 1] - g.first[v]);
}

std::span<const std::uint32_t> cornersOf(const ClusterGrowth& g, std::uint32_t triangle) {
    return g.corners.subspan(3 * std::size_t{triangle}, 3);
}

// The vertex is in the cluster: the triangles around it touch that, or more than they did.
void addVertex(ClusterGrowth& g, std::uint32_t v) {
    const auto cluster = static_cast<std::uint32_t>(g.result.sizes.size());
    if (g.lastCluster[v] == cluster) return;
    g.lastCluster[v] = cluster;
    for (const std::uint32_t triangle : trianglesAround(g, v)) {
        if (g.taken[triangle] != 0) continue;
        int inside = 0;
        bool hangs = false;
        for (const std::uint32_t corner : cornersOf(g, triangle)) {
            inside += g.lastCluster[corner] == cluster ? 1 : 0;
            hangs = hangs || g.open[corner] == 1;
        }
        if (inside == 3)
            g.closed.push_back(triangle);
        else if (hangs)
            g.hanging.push_back(triangle);
        else
            (inside == 2 ? g.beside : g.touching).push_back(triangle);
    }
}

void take(ClusterGrowth& g, std::uint32_t triangle) {
    g.taken[triangle] = 1;
    g.result.triangles.push_back(triangle);
    ++g.size;
    g.centres += g.facets[triangle].centre;
    g.normals += g.facets[triangle].normal;
    for (const std::uint32_t v : cornersOf(g, triangle))
        if (--g.open[v] == 1)
            for (const std::uint32_t last : trianglesAround(g, v))
                if (g.taken[last] == 0) g.hanging.push_back(last);
    for (const std::uint32_t v : cornersOf(g, triangle)) addVertex(g, v);
}

// Takes from the end of a list what doesn't face away from the cluster, as the back of a thin sheet does;
// noTriangle if there is none.
std::uint32_t lastFacing(ClusterGrowth& g, std::vector<std::uint32_t>& list) {
    while (!list.empty()) {
        const std::uint32_t triangle = list.back();
        list.pop_back();
        if (g.taken[triangle] != 0) continue;
        if (!(glm::dot(g.facets[triangle].normal, g.normals) < 0)) return triangle;
        g.beside.push_back(triangle);
    }
    return noTriangle;
}

void keepOpen(const ClusterGrowth& g, std::vector<std::uint32_t>& list) {
    std::erase_if(list, [&](std::uint32_t triangle) { return g.taken[triangle] != 0; });
}

// That of the list which lies nearest and faces most as the cluster does.
std::uint32_t mostAlike(const ClusterGrowth& g, const std::vector<std::uint32_t>& list) {
    const glm::vec3 centre = g.centres / static_cast<float>(g.size);
    const float length = glm::length(g.normals);
    const glm::vec3 normal = length > 0 ? coneWeight / length * g.normals : glm::vec3(0);
    const float perLength = (1 - coneWeight) / g.radius;
    std::uint32_t best = noTriangle;
    float least = std::numeric_limits<float>::infinity();
    for (const std::uint32_t triangle : list) {
        const Facet& facet = g.facets[triangle];
        const float turn = std::max(leastTurn, 1 - glm::dot(facet.normal, normal));
        const float price = (1 + perLength * glm::distance(facet.centre, centre)) * turn;
        if (!(price < least) && best != noTriangle) continue;
        least = price;
        best = triangle;
    }
    return best;
}

std::uint32_t nextInside(ClusterGrowth& g) {
    if (const std::uint32_t triangle = lastFacing(g, g.closed); triangle != noTriangle) return triangle;
    if (const std::uint32_t triangle = lastFacing(g, g.hanging); triangle != noTriangle) return triangle;
    keepOpen(g, g.beside);
    if (!g.beside.empty()) return mostAlike(g, g.beside);
    keepOpen(g, g.touching);
    return mostAlike(g, g.touching);
}

// What touches the full cluster and has the fewest open neighbours: later it might be left alone.
std::uint32_t seedBeside(const ClusterGrowth& g) {
    std::uint32_t best = noTriangle;
    std::uint32_t fewest = noTriangle;
    for (const auto* const list : {&g.hanging, &g.closed, &g.beside, &g.touching})
        for (const std::uint32_t triangle : *list) {
            if (g.taken[triangle] != 0) continue;
            const auto v = cornersOf(g, triangle);
            const std::uint32_t openings = g.open[v[0]] + g.open[v[1]] + g.open[v[2]];
            if (openings >= fewest) continue;
            fewest = openings;
            best = triangle;
        }
    return best;
}

// The nearest to `place` of those that touched the clusters before, the last first; else the next in order.
std::uint32_t seedElsewhere(ClusterGrowth& g, const glm::vec3& place) {
    while (!g.left.empty() && g.taken[g.left.back()] != 0) g.left.pop_back();
    std::uint32_t best = noTriangle;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < std::min(seedsAhead, g.left.size()); ++i) {
        const std::uint32_t triangle = g.left[g.left.size() - 1 - i];
        if (g.taken[triangle] != 0) continue;
        const float distance = glm::distance(g.facets[triangle].centre, place);
        if (!(distance < least) && best != noTriangle) continue;
        least = distance;
        best = triangle;
    }
    if (best != noTriangle) return best;
    while (g.taken[g.unseen] != 0) ++g.unseen;
    return g.unseen;
}

// Of what touches the cluster only as much stays known as is looked at: at one vertex there may be any number.
void close(ClusterGrowth& g) {
    for (auto* const list : {&g.touching, &g.beside, &g.hanging, &g.closed}) {
        keepOpen(g, *list);
        const auto kept = static_cast<std::ptrdiff_t>(std::min(seedsAhead, list->size()));
        g.left.insert(g.left.end(), list->end() - kept, list->end());
        list->clear();
    }
    g.result.sizes.push_back(g.size);
    g.size = 0;
    g.centres = g.normals = glm::vec3(0);
}

}  // namespace

GrownClusters growClusters(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions,
                           std::uint32_t most) {
    ClusterGrowth g;
    g.corners = corners;
    measureFacets(g, positions, most);
    connect(g, positions.size());
    const std::size_t count = corners.size() / 3;
    g.result.triangles.reserve(count);
    while (g.result.triangles.size() < count) {
        const bool full = g.size == most;
        std::uint32_t next = full ? seedBeside(g) : nextInside(g);
        const glm::vec3 place = g.size > 0 ? g.centres / static_cast<float>(g.size) : glm::vec3(0);
        if (full || (next == noTriangle && g.size >= most / 2)) close(g);
        if (next == noTriangle) next = seedElsewhere(g, place);
        take(g, next);
    }
    if (g.size > 0) close(g);
    return std::move(g.result);
}

}  // namespace defocus
