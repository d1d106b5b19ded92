#include "lod/pyramid/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>

#include "core/bounds.h"

namespace defocus::engine {

namespace {

// ---- assign triangles to growing clusters ------------------------------------------------------

constexpr float coneWeight = 0.75f;     // weight of orientation relative to distance in the cost of a triangle, 0 to 1
constexpr float minTurn = 1e-3f;        // lower bound of the orientation factor in a triangle's cost
constexpr std::size_t seedsAhead = 64;  // max unassigned triangles kept as candidates for a cluster's first triangle
// Max number of triangles per vertex that are considered when a cluster grows. Files may have millions of triangles at
// one vertex.
constexpr std::size_t maxNeighbours = 1024;

struct Facet {
    glm::vec3 centre{0};
    glm::vec3 normal{0};  // unit length; zero for a triangle without area
};

using ClusterNumber = Number<struct ClusterKind>;

// The finished clusters, the growing cluster, and candidates for its next triangle.
struct ClusterGrowth {
    ClusterGrowth(const Numbered<TriangleCorner, LocalNumber>& all, std::size_t placeCount)
        : corners(all), around(placeCount, all.size(), [&](TriangleCorner corner) { return all[corner]; }) {}

    const Numbered<TriangleCorner, LocalNumber>& corners;
    Buckets<LocalNumber, TriangleCorner> around;
    // For each vertex with more than maxNeighbours triangles: the triangles of this many first entries of `around` at
    // the vertex are known to belong to clusters.
    std::unordered_map<LocalNumber, std::size_t> firstOpen;
    Numbered<TriangleNumber, Facet> facets;
    float radius = 0;  // radius of a full cluster on a flat mesh with equal triangles

    Numbered<LocalNumber, std::uint32_t> open;         // per position, number of corners of unassigned triangles
    Numbered<LocalNumber, ClusterNumber> lastCluster;  // per position, the last cluster that contains the position
    Numbered<TriangleNumber, std::uint8_t> taken;

    // Number of triangles, sum of centres and sum of normals of the growing cluster.
    std::uint32_t size = 0;
    glm::vec3 centres{0};
    glm::vec3 normals{0};
    // Lists of triangles that touch the growing cluster, or, in `left`, earlier clusters. Some of the triangles may
    // already be assigned to a cluster.
    std::vector<TriangleNumber> closed;    // triangles with all three corners in the growing cluster
    std::vector<TriangleNumber> hanging;   // triangles that are the last unassigned triangle at one of their vertices
    std::vector<TriangleNumber> beside;    // triangles with two corners in the growing cluster
    std::vector<TriangleNumber> touching;  // triangles with one corner in the growing cluster
    std::vector<TriangleNumber> left;      // unassigned triangles that touch earlier clusters
    TriangleNumber unseen{0};              // all triangles before this triangle are assigned to clusters

    GrownClusters result;

    [[nodiscard]] std::array<LocalNumber, 3> cornersOf(TriangleNumber triangle) const {
        return {corners[cornerAt(triangle, 0)], corners[cornerAt(triangle, 1)], corners[cornerAt(triangle, 2)]};
    }
};

void measureFacets(ClusterGrowth& g, const Numbered<LocalNumber, glm::vec3>& positions, std::uint32_t max) {
    const std::size_t count = g.corners.size() / 3;
    g.facets.reserve(count);
    double area = 0;
    for (const auto t : numbersBelow<TriangleNumber>(count)) {
        const auto corners = g.cornersOf(t);
        const glm::vec3& a = positions[corners[0]];
        const glm::vec3& b = positions[corners[1]];
        const glm::vec3& c = positions[corners[2]];
        const glm::vec3 cross = glm::cross(b - a, c - a);
        const float doubleArea = glm::length(cross);
        g.facets.push_back({(a + b + c) / 3.0f, doubleArea > 0 ? cross / doubleArea : glm::vec3(0)});
        area += 0.5 * double{doubleArea};
    }
    g.radius = static_cast<float>(0.5 * std::sqrt(area / static_cast<double>(count) * max));
}

// Returns the triangle corners at the vertex: all of them if there are at most maxNeighbours, else at most
// maxNeighbours corners of unassigned triangles. Moves corners of assigned triangles to the front of the vertex's list,
// so that later calls skip them.
std::span<const TriangleCorner> someAround(ClusterGrowth& g, LocalNumber v) {
    const std::span<TriangleCorner> all = g.around[v];
    if (all.size() <= maxNeighbours) return all;
    std::size_t& first = g.firstOpen[v];
    std::size_t end = first;
    for (; end < all.size() && end - first < maxNeighbours; ++end)
        if (g.taken[faceOf(all[end])] != 0) std::swap(all[first++], all[end]);
    return all.subspan(first, end - first);
}

// Adds a vertex to the growing cluster and sorts the unassigned triangles around it into the lists of neighbours.
void addVertex(ClusterGrowth& g, LocalNumber v) {
    const auto cluster = itemAt<ClusterNumber>(g.result.sizes.size());
    if (g.lastCluster[v] == cluster) return;
    g.lastCluster[v] = cluster;
    for (const TriangleCorner around : someAround(g, v)) {
        const TriangleNumber triangle = faceOf(around);
        if (g.taken[triangle] != 0) continue;
        int inside = 0;
        bool hangs = false;
        for (const LocalNumber corner : g.cornersOf(triangle)) {
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

void take(ClusterGrowth& g, TriangleNumber triangle) {
    g.taken[triangle] = 1;
    g.result.triangles.push_back(triangle);
    ++g.size;
    g.centres += g.facets[triangle].centre;
    g.normals += g.facets[triangle].normal;
    for (const LocalNumber v : g.cornersOf(triangle))
        if (--g.open[v] == 1)
            for (const TriangleCorner last : g.around[v])
                if (g.taken[faceOf(last)] == 0) g.hanging.push_back(faceOf(last));
    for (const LocalNumber v : g.cornersOf(triangle)) addVertex(g, v);
}

// Removes and returns the last triangle of the list that does not face away from the growing cluster, or an invalid
// number if there is none. Triangles that face away, such as the back of a thin plate, move to the list `beside`.
TriangleNumber lastFacing(ClusterGrowth& g, std::vector<TriangleNumber>& list) {
    while (!list.empty()) {
        const TriangleNumber triangle = list.back();
        list.pop_back();
        if (g.taken[triangle] != 0) continue;
        if (!(glm::dot(g.facets[triangle].normal, g.normals) < 0)) return triangle;
        g.beside.push_back(triangle);
    }
    return {};
}

void keepOpen(const ClusterGrowth& g, std::vector<TriangleNumber>& list) {
    std::erase_if(list, [&](TriangleNumber triangle) { return g.taken[triangle] != 0; });
}

// Returns the triangle of the list that is most similar to the growing cluster in position and orientation.
TriangleNumber closestMatch(const ClusterGrowth& g, const std::vector<TriangleNumber>& list) {
    const glm::vec3 centre = g.centres / static_cast<float>(g.size);
    const float length = glm::length(g.normals);
    const glm::vec3 normal = length > 0 ? coneWeight / length * g.normals : glm::vec3(0);
    const float perLength = (1 - coneWeight) / g.radius;
    TriangleNumber best;
    float min = std::numeric_limits<float>::infinity();
    for (const TriangleNumber triangle : list) {
        const Facet& facet = g.facets[triangle];
        const float turn = std::max(minTurn, 1 - glm::dot(facet.normal, normal));
        const float price = (1 + perLength * glm::distance(facet.centre, centre)) * turn;
        if (!(price < min) && best.isValid()) continue;
        min = price;
        best = triangle;
    }
    return best;
}

TriangleNumber nextInside(ClusterGrowth& g) {
    if (const TriangleNumber triangle = lastFacing(g, g.closed); triangle.isValid()) return triangle;
    if (const TriangleNumber triangle = lastFacing(g, g.hanging); triangle.isValid()) return triangle;
    keepOpen(g, g.beside);
    if (!g.beside.empty()) return closestMatch(g, g.beside);
    keepOpen(g, g.touching);
    return closestMatch(g, g.touching);
}

// Among the unassigned triangles that touch the full cluster, returns the one with the fewest unassigned triangles at
// its vertices, because this triangle might otherwise be left isolated.
TriangleNumber seedBeside(const ClusterGrowth& g) {
    TriangleNumber best;
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    for (const auto* const list : {&g.hanging, &g.closed, &g.beside, &g.touching})
        for (const TriangleNumber triangle : *list) {
            if (g.taken[triangle] != 0) continue;
            const auto v = g.cornersOf(triangle);
            const std::uint32_t openings = g.open[v[0]] + g.open[v[1]] + g.open[v[2]];
            if (openings >= fewest) continue;
            fewest = openings;
            best = triangle;
        }
    return best;
}

// Returns the unassigned triangle nearest to `place` among the last `seedsAhead` entries of `left`, which touch earlier
// clusters. If there are none, returns the first unassigned triangle of the primitive.
TriangleNumber seedElsewhere(ClusterGrowth& g, const glm::vec3& place) {
    while (!g.left.empty() && g.taken[g.left.back()] != 0) g.left.pop_back();
    TriangleNumber best;
    float min = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < std::min(seedsAhead, g.left.size()); ++i) {
        const TriangleNumber triangle = g.left[g.left.size() - 1 - i];
        if (g.taken[triangle] != 0) continue;
        const float distance = glm::distance(g.facets[triangle].centre, place);
        if (!(distance < min) && best.isValid()) continue;
        min = distance;
        best = triangle;
    }
    if (best.isValid()) return best;
    while (g.taken[g.unseen] != 0) ++g.unseen.value;
    return g.unseen;
}

// Finishes the growing cluster. The four lists hold triangles that touch the cluster. From each list, keeps at most
// `seedsAhead` unassigned triangles as seeds (first triangles) of later clusters. The limit is needed because many
// triangles can share a vertex.
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

GrownClusters growClusters(const Numbered<TriangleCorner, LocalNumber>& corners,
                           const Numbered<LocalNumber, glm::vec3>& positions, std::uint32_t max) {
    ClusterGrowth g(corners, positions.size());
    measureFacets(g, positions, max);
    g.open.resize(positions.size());
    for (const LocalNumber v : corners) ++g.open[v];
    g.lastCluster.resize(positions.size());
    const std::size_t count = corners.size() / 3;
    g.taken.resize(count);
    g.result.triangles.reserve(count);
    while (g.result.triangles.size() < count) {
        const bool full = g.size == max;
        TriangleNumber next = full ? seedBeside(g) : nextInside(g);
        const glm::vec3 place = g.size > 0 ? g.centres / static_cast<float>(g.size) : glm::vec3(0);
        if (full || (!next.isValid() && g.size >= max / 2)) close(g);
        if (!next.isValid()) next = seedElsewhere(g, place);
        take(g, next);
    }
    if (g.size > 0) close(g);
    return std::move(g.result);
}

// ---- compute the bounds of a cluster -----------------------------------------------------------

namespace {

// Bound on the rounding error of a single-precision result, relative to the magnitude of its operands.
constexpr double valueRounding = 1e-6;

// Replaces NaN and infinite positions by 0.
glm::vec3 finitePosition(const glm::vec3& position) {
    return isFinite(position) ? position : glm::vec3(0);
}

// A primitive's triangles with positions numbered from 0, so that the time to cluster them depends only on the size of
// the primitive.
struct LocalTriangles {
    Numbered<TriangleCorner, LocalNumber> corners;
    Numbered<LocalNumber, glm::vec3> positions;
};

// Returns a primitive's triangles. All entries of `localOf` must be invalid before the call, and are invalid after the
// call.
template <typename Vertex>
LocalTriangles localTriangles(std::span<const Vertex> indices, std::span<const glm::vec3> positions,
                              const Numbered<Vertex, PositionNumber>& places,
                              Numbered<PositionNumber, LocalNumber>& localOf) {
    LocalTriangles local;
    local.corners.reserve(indices.size());
    for (const Vertex v : indices) {
        LocalNumber& number = localOf[places[v]];
        if (!number.isValid()) {
            number = local.positions.next();
            local.positions.push_back(finitePosition(positions[indexOf(v)]));
        }
        local.corners.push_back(number);
    }
    for (const Vertex v : indices) localOf[places[v]] = {};
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

template <typename Vertex>
Cluster measured(std::span<const Vertex> indices, std::span<const glm::vec3> positions) {
    std::vector<ClusterTriangle> triangles(indices.size() / 3);
    glm::vec3 min = finitePosition(positions[indexOf(indices.front())]);
    glm::vec3 max = min;
    glm::dvec3 sum(0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        ClusterTriangle& triangle = triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = finitePosition(positions[indexOf(indices[3 * t + k])]);
            min = glm::min(min, p);
            max = glm::max(max, p);
            triangle.p[k] = glm::dvec3(p);
        }
        triangle.cross = glm::cross(triangle.p[1] - triangle.p[0], triangle.p[2] - triangle.p[0]);
        sum += triangle.cross;
    }

    // Compute the cluster's bounding sphere, and the cone of normals around their area-weighted mean.
    Cluster cluster;
    cluster.centre = glm::vec3(0.5 * (glm::dvec3(min) + glm::dvec3(max)));
    const glm::dvec3 centre(cluster.centre);
    if (glm::length(sum) > 0) cluster.axis = glm::vec3(glm::normalize(sum));
    const glm::dvec3 axis(cluster.axis);
    double squaredRadius = 0;
    double minCosine = 1;
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
        minCosine = std::min(minCosine, glm::dot(normal, axis));
        planes = std::min(planes, glm::dot(normal, triangle.p[0] - centre));
    }
    const double radius = std::sqrt(squaredRadius);
    cluster.radius = static_cast<float>(radius * (1 + valueRounding));
    cluster.minCosine = static_cast<float>(minCosine - valueRounding);
    cluster.planes = static_cast<float>(std::max(planes, -radius) - valueRounding * radius);
    cluster.minAltitude = std::isfinite(altitude) ? static_cast<float>(altitude * (1 - valueRounding)) : 0;
    return cluster;
}

// Reorders the triangles of a primitive so that clusters are contiguous, and appends the clusters to `result`. `first`
// is the offset of the primitive's first index in the level.
template <typename Vertex>
void clusterPrimitive(std::span<Vertex> indices, std::span<const glm::vec3> positions, const LocalTriangles& local,
                      std::uint32_t first, std::vector<Cluster>& result) {
    const GrownClusters grown = growClusters(local.corners, local.positions, maxClusterTriangles);
    const std::vector<Vertex> unordered(indices.begin(), indices.end());
    for (std::size_t t = 0; t < grown.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) indices[3 * t + k] = unordered[3 * indexOf(grown.triangles[t]) + k];
    for (const std::uint32_t size : grown.sizes) {
        result.push_back(measured<Vertex>(indices.first(3 * std::size_t{size}), positions));
        result.back().indices = {first, 3 * size};
        indices = indices.subspan(3 * std::size_t{size});
        first += 3 * size;
    }
}

}  // namespace

template <typename Vertex>
std::vector<Cluster> clusterTriangles(TriangleSet<Vertex>& level, std::span<const glm::vec3> positions,
                                      const Numbered<Vertex, PositionNumber>& places, std::size_t placeCount) {
    std::vector<Cluster> result;
    result.reserve(level.indices.size() / (3 * maxClusterTriangles) + level.primitiveIndexCounts.size());
    Numbered<PositionNumber, LocalNumber> localOf(placeCount);
    std::uint32_t first = 0;
    for (const std::uint32_t count : level.primitiveIndexCounts) {
        if (count == 0) continue;
        const std::span<Vertex> indices = std::span(level.indices).subspan(first, count);
        clusterPrimitive(indices, positions, localTriangles<Vertex>(indices, positions, places, localOf), first,
                         result);
        first += count;
    }
    return result;
}

template std::vector<Cluster> clusterTriangles(TriangleSet<MeshVertexNumber>&, std::span<const glm::vec3>,
                                               const Numbered<MeshVertexNumber, PositionNumber>&, std::size_t);
template std::vector<Cluster> clusterTriangles(TriangleSet<LevelVertexNumber>&, std::span<const glm::vec3>,
                                               const Numbered<LevelVertexNumber, PositionNumber>&, std::size_t);

}  // namespace defocus::engine
