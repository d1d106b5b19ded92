// Cutting non-manifold surfaces: after Guéziec, Taubin, Lazarus and Horn 2001, Cutting and Stitching: Converting Sets
// of Polygons to Manifold Surfaces.

#include "lod/simplify/manifold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "lod/simplify/triangle_set.h"

namespace defocus {

namespace {

// Beyond this many faces at one edge nothing continues anything: all are cut apart, in time linear in their number.
constexpr std::size_t mostFacesToPair = 32;

// What a face was repaired by.
constexpr std::uint8_t turnedRepair = 1;
constexpr std::uint8_t cutRepair = 2;
constexpr std::uint8_t splitRepair = 4;

// What is known while the surface is put together; faces are those that were kept, corners and half-edges are 3·face +
// i.
struct PairedSurface {
    const std::vector<glm::dvec3>& points;
    std::vector<std::uint32_t> at;          // welded position of each corner
    std::vector<std::uint32_t> primitives;  // of each face
    std::vector<std::uint8_t> turned;
    std::vector<std::uint8_t> repaired;  // of each face: turnedRepair, cutRepair, splitRepair
    std::vector<std::uint32_t> twins;

    [[nodiscard]] std::size_t faceCount() const { return primitives.size(); }
    [[nodiscard]] std::uint32_t start(std::uint32_t edge) const { return at[edge]; }
    [[nodiscard]] std::uint32_t end(std::uint32_t edge) const { return at[nextCorner(edge)]; }
    // Which way the edge is run through once its face has been turned or not.
    [[nodiscard]] bool forward(std::uint32_t edge) const {
        return (start(edge) < end(edge)) != (turned[edge / 3] != 0);
    }
};

// Keys 0 … keyCount − 1 as buckets: what has key k is at first[k] … first[k + 1] − 1, in the order it came.
template <typename Key>
std::vector<std::uint32_t> bucketed(std::uint32_t count, std::size_t keyCount, const Key& key,
                                    std::vector<std::uint32_t>& first) {
    constexpr auto skipped = Manifold::none;
    first.assign(keyCount + 1, 0);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t k = key(i); k != skipped) ++first[k + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> order(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t k = key(i); k != skipped) order[next[k]++] = i;
    return order;
}

// The faces that are neither degenerate nor repetitions, in input order.
std::vector<std::uint32_t> properFaces(const TriangleSet& triangles, const std::vector<std::uint32_t>& primitives,
                                       std::size_t positionCount) {
    const auto corners = [&](std::uint32_t face) { return &triangles.indices[3 * std::size_t{face}]; };
    const auto least = [&](std::uint32_t face) {
        const std::uint32_t* p = corners(face);
        if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) return Manifold::none;
        return std::min({p[0], p[1], p[2]});
    };
    const auto faceCount = static_cast<std::uint32_t>(triangles.count());
    std::vector<std::uint32_t> first;
    const std::vector<std::uint32_t> order = bucketed(faceCount, positionCount, least, first);

    // Equal faces share their smallest position; few have any one.
    struct Key {
        std::array<std::uint32_t, 3> value;  // the other two positions in winding order, then the primitive
        std::uint32_t face;
    };
    std::vector<Key> keys;
    std::vector<std::uint8_t> kept(faceCount, 0);
    for (std::size_t position = 0; position < positionCount; ++position) {
        keys.clear();
        for (std::uint32_t i = first[position]; i < first[position + 1]; ++i) {
            const std::uint32_t* p = corners(order[i]);
            const auto at = static_cast<std::size_t>(std::find(p, p + 3, position) - p);
            keys.push_back({{p[(at + 1) % 3], p[(at + 2) % 3], primitives[order[i]]}, order[i]});
        }
        std::sort(keys.begin(), keys.end(),
                  [](const Key& a, const Key& b) { return a.value != b.value ? a.value < b.value : a.face < b.face; });
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (i == 0 || keys[i].value != keys[i - 1].value) kept[keys[i].face] = 1;
    }
    std::vector<std::uint32_t> faces;
    faces.reserve(order.size());
    for (std::uint32_t face = 0; face < faceCount; ++face)
        if (kept[face] != 0) faces.push_back(face);
    return faces;
}

// The half-edges grouped by the pair of positions that they join: group g is order[starts[g]] … order[starts[g + 1] −
// 1].
struct EdgeGroups {
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> starts;
};

EdgeGroups groupEdges(const PairedSurface& surface) {
    const auto edgeCount = static_cast<std::uint32_t>(surface.at.size());
    const auto low = [&](std::uint32_t e) { return std::min(surface.start(e), surface.end(e)); };
    const auto high = [&](std::uint32_t e) { return std::max(surface.start(e), surface.end(e)); };

    // Bucket by the lower position, then sort the few edges of each bucket by the higher one.
    std::vector<std::uint32_t> first;
    EdgeGroups groups;
    groups.order = bucketed(edgeCount, surface.points.size(), low, first);
    groups.starts.reserve(edgeCount / 2 + edgeCount / 16);
    std::vector<std::uint64_t> keys;  // higher positions above half-edges
    for (std::size_t p = 0; p + 1 < first.size(); ++p) {
        keys.clear();
        for (std::uint32_t i = first[p]; i < first[p + 1]; ++i)
            keys.push_back(std::uint64_t{high(groups.order[i])} << 32 | groups.order[i]);
        std::sort(keys.begin(), keys.end());
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const auto i = static_cast<std::uint32_t>(first[p] + k);
            groups.order[i] = static_cast<std::uint32_t>(keys[k]);
            if (k == 0 || keys[k] >> 32 != keys[k - 1] >> 32) groups.starts.push_back(i);
        }
    }
    groups.starts.push_back(edgeCount);
    return groups;
}

// Turns the minority of each component's faces so that neighbours across edges of two faces agree, where they can (a
// Möbius band stays cut at one edge).
void orient(PairedSurface& surface, const EdgeGroups& groups) {
    std::vector<std::uint32_t> across(surface.at.size(), Manifold::none);
    for (std::size_t g = 0; g + 1 < groups.starts.size(); ++g) {
        if (groups.starts[g + 1] - groups.starts[g] != 2) continue;
        const std::uint32_t a = groups.order[groups.starts[g]];
        const std::uint32_t b = groups.order[groups.starts[g] + 1];
        const bool sameFace = surface.at[previousCorner(a)] == surface.at[previousCorner(b)];
        if (sameFace && surface.forward(a) == surface.forward(b)) continue;  // once more in another primitive
        across[a] = b;
        across[b] = a;
    }

    std::vector<std::uint8_t> reached(surface.faceCount(), 0);
    std::vector<std::uint32_t> component;
    for (std::uint32_t seed = 0; seed < surface.faceCount(); ++seed) {
        if (reached[seed] != 0) continue;
        reached[seed] = 1;
        component.assign(1, seed);
        std::size_t turnedCount = 0;
        for (std::size_t i = 0; i < component.size(); ++i) {
            for (std::uint32_t e = 3 * component[i]; e < 3 * component[i] + 3; ++e) {
                if (across[e] == Manifold::none || reached[across[e] / 3] != 0) continue;
                const std::uint32_t neighbour = across[e] / 3;
                reached[neighbour] = 1;
                if (surface.forward(e) == surface.forward(across[e])) {
                    surface.turned[neighbour] = 1;
                    ++turnedCount;
                }
                component.push_back(neighbour);
            }
        }
        const bool turnOthers = 2 * turnedCount > component.size();
        for (const std::uint32_t face : component) {
            if (turnOthers) surface.turned[face] ^= 1;
            if (surface.turned[face] != 0) surface.repaired[face] |= turnedRepair;
        }
    }
}

glm::dvec3 faceNormal(const PairedSurface& surface, std::uint32_t face) {
    const glm::dvec3& a = surface.points[surface.at[3 * face]];
    glm::dvec3 normal =
        glm::cross(surface.points[surface.at[3 * face + 1]] - a, surface.points[surface.at[3 * face + 2]] - a);
    if (surface.turned[face] != 0) normal = -normal;
    const double length = glm::length(normal);
    return length > 0 ? normal / length : glm::dvec3(0);
}

// Pairs the half-edges at one edge: same primitive before flatter before earlier. A face and its reverse (a sheet with
// two faces) only close onto each other where nothing else continues them.
void pairEdges(PairedSurface& surface, const std::uint32_t* edges, std::size_t count) {
    struct Candidate {
        double score;
        std::uint32_t forward, backward;
    };
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < count && count <= mostFacesToPair; ++i) {
        if (!surface.forward(edges[i])) continue;
        const glm::dvec3 normal = faceNormal(surface, edges[i] / 3);
        for (std::size_t j = 0; j < count; ++j) {
            if (surface.forward(edges[j])) continue;
            const std::uint32_t a = edges[i];
            const std::uint32_t b = edges[j];
            double score = glm::dot(normal, faceNormal(surface, b / 3));
            if (surface.primitives[a / 3] == surface.primitives[b / 3]) score += 4;
            if (surface.at[previousCorner(a)] == surface.at[previousCorner(b)]) score -= 16;
            candidates.push_back({score, a, b});
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    for (const Candidate& candidate : candidates) {
        if (surface.twins[candidate.forward] != Manifold::none || surface.twins[candidate.backward] != Manifold::none)
            continue;
        surface.twins[candidate.forward] = candidate.backward;
        surface.twins[candidate.backward] = candidate.forward;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (surface.twins[edges[i]] == Manifold::none) surface.repaired[edges[i] / 3] |= cutRepair;
}

void pairAllEdges(PairedSurface& surface, const EdgeGroups& groups) {
    for (std::size_t g = 0; g + 1 < groups.starts.size(); ++g) {
        const std::uint32_t* edges = &groups.order[groups.starts[g]];
        const std::size_t count = groups.starts[g + 1] - groups.starts[g];
        if (count == 1) continue;
        if (count == 2 && surface.forward(edges[0]) != surface.forward(edges[1])) {
            surface.twins[edges[0]] = edges[1];
            surface.twins[edges[1]] = edges[0];
        } else {
            pairEdges(surface, edges, count);
        }
    }
}

// Numbers the fans: corners that are joined by paired edges are one vertex. Union-find, the smaller corner is the root.
void numberVertices(PairedSurface& surface, Manifold& manifold) {
    std::vector<std::uint32_t> parent(surface.at.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t corner) {
        while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
        return corner;
    };
    for (std::uint32_t e = 0; e < surface.at.size(); ++e) {
        const std::uint32_t twin = surface.twins[e];
        if (twin == Manifold::none || twin < e) continue;
        for (const std::uint32_t mine : {e, nextCorner(e)}) {
            const std::uint32_t theirs = surface.at[mine] == surface.at[twin] ? twin : nextCorner(twin);
            const std::uint32_t a = root(mine);
            const std::uint32_t b = root(theirs);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }

    manifold.corners.resize(surface.at.size());
    std::vector<std::uint8_t> taken(surface.points.size(), 0);  // positions that have a vertex already
    std::vector<std::uint8_t> further;                          // for each vertex: not the first of its position
    for (std::uint32_t corner = 0; corner < surface.at.size(); ++corner) {
        const std::uint32_t fan = root(corner);
        if (fan == corner) {
            manifold.corners[corner] = static_cast<std::uint32_t>(manifold.positions.size());
            manifold.positions.push_back(surface.at[corner]);
            further.push_back(taken[surface.at[corner]]);
            taken[surface.at[corner]] = 1;
        }
        manifold.corners[corner] = manifold.corners[fan];
        if (further[manifold.corners[corner]] != 0) surface.repaired[corner / 3] |= splitRepair;
    }
}

Repairs repairsOf(const PairedSurface& surface, std::size_t inputFaces) {
    Repairs repairs;
    repairs.dropped = static_cast<std::uint32_t>(inputFaces - surface.faceCount());
    repairs.faces = repairs.dropped;
    for (const std::uint8_t repair : surface.repaired) {
        repairs.faces += repair != 0 ? 1 : 0;
        repairs.turned += (repair & turnedRepair) != 0 ? 1 : 0;
        repairs.cut += (repair & cutRepair) != 0 ? 1 : 0;
        repairs.split += (repair & splitRepair) != 0 ? 1 : 0;
    }
    return repairs;
}

}  // namespace

TriangleSet weldedTriangles(const TriangleSet& triangles, const Welded& positions,
                            const std::vector<glm::dvec3>& points) {
    TriangleSet welded;
    welded.primitiveIndexCounts = triangles.primitiveIndexCounts;
    welded.indices.reserve(triangles.indices.size());
    for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3) {
        const std::uint32_t p[3] = {positions.id[triangles.indices[i]], positions.id[triangles.indices[i + 1]],
                                    positions.id[triangles.indices[i + 2]]};
        const glm::dvec3 sum = points[p[0]] + points[p[1]] + points[p[2]];
        const bool proper = std::isfinite(sum.x + sum.y + sum.z);
        for (const std::uint32_t corner : p) welded.indices.push_back(proper ? corner : p[0]);
    }
    return welded;
}

Manifold buildManifold(const TriangleSet& triangles, const std::vector<glm::dvec3>& points) {
    // Keep the faces that can be part of a surface.
    Manifold manifold;
    const std::vector<std::uint32_t> primitives = primitivesOf(triangles);
    manifold.faces = properFaces(triangles, primitives, points.size());
    const std::size_t count = manifold.faces.size();
    PairedSurface surface{points, {}, {}, {}, {}, {}};
    surface.turned.assign(count, 0);
    surface.repaired.assign(count, 0);
    surface.twins.assign(3 * count, Manifold::none);
    surface.at.reserve(3 * count);
    surface.primitives.reserve(count);
    for (const std::uint32_t face : manifold.faces) {
        for (std::size_t i = 0; i < 3; ++i) surface.at.push_back(triangles.indices[3 * std::size_t{face} + i]);
        surface.primitives.push_back(primitives[face]);
    }

    // Make neighbours agree, join them edge by edge, and give each fan its vertex.
    const EdgeGroups groups = groupEdges(surface);
    orient(surface, groups);
    pairAllEdges(surface, groups);
    numberVertices(surface, manifold);

    manifold.turned = std::move(surface.turned);
    manifold.twins = std::move(surface.twins);
    manifold.repairs = repairsOf(surface, triangles.count());
    return manifold;
}

}  // namespace defocus
