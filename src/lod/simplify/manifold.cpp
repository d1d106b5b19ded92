// Converts triangles to a manifold by cutting the surface at non-manifold edges and vertices, as in Guéziec, Taubin,
// Lazarus and Horn 2001, Cutting and Stitching: Converting Sets of Polygons to Manifold Surfaces.

#include "lod/simplify/manifold.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "lod/simplify/triangle_set.h"

namespace defocus::engine {

namespace {

// Max number of faces at one edge for which the best-matching pairs of faces are found, in quadratic time. At an edge
// with more faces, all faces are separated.
constexpr std::size_t maxFacesToPair = 32;

// Bit flags that say how a face was repaired.
constexpr std::uint8_t turnedRepair = 1;
constexpr std::uint8_t cutRepair = 2;
constexpr std::uint8_t splitRepair = 4;

// The surface while half-edges are paired. Its faces are the input triangles that were kept.
struct PairedSurface {
    const Numbered<PositionNumber, glm::dvec3>& points;
    Numbered<SurfaceCorner, PositionNumber> at;
    Numbered<SurfaceFaceNumber, PrimitiveNumber> primitives;
    Numbered<SurfaceFaceNumber, std::uint8_t> turned;
    Numbered<SurfaceFaceNumber, std::uint8_t> repaired;  // flags turnedRepair, cutRepair, splitRepair
    Numbered<SurfaceCorner, SurfaceCorner> twins;

    [[nodiscard]] std::size_t faceCount() const { return primitives.size(); }
    [[nodiscard]] PositionNumber start(SurfaceCorner edge) const { return at[edge]; }
    [[nodiscard]] PositionNumber end(SurfaceCorner edge) const { return at[nextCorner(edge)]; }
    // Returns true if the half-edge leads from the lower to the higher position number, in the final orientation of its
    // face.
    [[nodiscard]] bool forward(SurfaceCorner edge) const {
        return (start(edge) < end(edge)) != (turned[faceOf(edge)] != 0);
    }
};

// Returns the triangles that are neither degenerate nor duplicates, in input order.
Numbered<SurfaceFaceNumber, TriangleNumber> properFaces(const TriangleSet<PositionNumber>& triangles,
                                                        const Numbered<TriangleNumber, PrimitiveNumber>& primitives,
                                                        std::size_t positionCount) {
    const Buckets<PositionNumber, TriangleNumber> atLeast(positionCount, triangles.count(),
                                                          [&](TriangleNumber triangle) {
                                                              const auto p = triangles.corners(triangle);
                                                              if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0])
                                                                  return PositionNumber();
                                                              return std::min({p[0], p[1], p[2]});
                                                          });

    // Sort key of a face. Only faces with the same smallest position number are compared, because equal faces share
    // this number.
    struct Key {
        PositionNumber next, previous;  // corners after and before the lowest-numbered corner, in winding order
        PrimitiveNumber primitive;
        TriangleNumber triangle;

        [[nodiscard]] auto face() const { return std::tie(next, previous, primitive); }
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys;
    Numbered<TriangleNumber, std::uint8_t> kept(triangles.count(), 0);
    for (const PositionNumber position : atLeast.keys()) {
        keys.clear();
        for (const TriangleNumber triangle : atLeast[position]) {
            const auto p = triangles.corners(triangle);
            const auto at = static_cast<std::size_t>(std::find(p.begin(), p.end(), position) - p.begin());
            keys.push_back({p[(at + 1) % 3], p[(at + 2) % 3], primitives[triangle], triangle});
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (i == 0 || keys[i].face() != keys[i - 1].face()) kept[keys[i].triangle] = 1;
    }
    Numbered<SurfaceFaceNumber, TriangleNumber> faces;
    faces.reserve(atLeast.itemCount());
    for (const TriangleNumber triangle : triangles.numbers())
        if (kept[triangle] != 0) faces.push_back(triangle);
    return faces;
}

// Half-edges grouped by the pair of positions that they join. Group g holds order[starts[g]] … order[starts[g + 1] −
// 1].
struct EdgeGroups {
    std::vector<SurfaceCorner> order;
    std::vector<std::uint32_t> starts;

    [[nodiscard]] std::size_t count() const { return starts.size() - 1; }
    [[nodiscard]] std::span<const SurfaceCorner> operator[](std::size_t g) const {
        return std::span(order).subspan(starts[g], starts[g + 1] - starts[g]);
    }
};

EdgeGroups groupEdges(const PairedSurface& surface) {
    const std::size_t edgeCount = surface.at.size();
    const auto low = [&](SurfaceCorner e) { return std::min(surface.start(e), surface.end(e)); };
    const auto high = [&](SurfaceCorner e) { return std::max(surface.start(e), surface.end(e)); };

    // Group half-edges by the smaller of their two position numbers, then sort the few half-edges of each group by the
    // larger number.
    Buckets<PositionNumber, SurfaceCorner> byLow(surface.points.size(), edgeCount, low);
    EdgeGroups groups;
    groups.starts.reserve(edgeCount / 2 + edgeCount / 16);
    std::uint32_t seen = 0;
    // for each half-edge, the larger of its two position numbers, and the half-edge itself
    std::vector<std::pair<PositionNumber, SurfaceCorner>> keys;
    for (const PositionNumber p : byLow.keys()) {
        keys.clear();
        const std::span<SurfaceCorner> edges = byLow[p];
        for (const SurfaceCorner e : edges) keys.emplace_back(high(e), e);
        std::sort(keys.begin(), keys.end());
        for (std::size_t k = 0; k < keys.size(); ++k) {
            edges[k] = keys[k].second;
            if (k == 0 || keys[k].first != keys[k - 1].first) groups.starts.push_back(seen);
            ++seen;
        }
    }
    groups.starts.push_back(seen);
    groups.order = byLow.takeItems();
    return groups;
}

// Makes the orientation of faces consistent across edges with two faces; reverses the minority of faces in each
// connected component. A Möbius band cannot be oriented consistently; one of its edges becomes a border.
void orient(PairedSurface& surface, const EdgeGroups& groups) {
    Numbered<SurfaceCorner, SurfaceCorner> across(surface.at.size());
    for (std::size_t g = 0; g < groups.count(); ++g) {
        if (groups[g].size() != 2) continue;
        const SurfaceCorner a = groups[g][0];
        const SurfaceCorner b = groups[g][1];
        const bool sameFace = surface.at[previousCorner(a)] == surface.at[previousCorner(b)];
        if (sameFace && surface.forward(a) == surface.forward(b)) continue;  // the same face occurs in two primitives
        across[a] = b;
        across[b] = a;
    }

    Numbered<SurfaceFaceNumber, std::uint8_t> reached(surface.faceCount(), 0);
    std::vector<SurfaceFaceNumber> component;
    for (const SurfaceFaceNumber seed : reached.numbers()) {
        if (reached[seed] != 0) continue;
        reached[seed] = 1;
        component.assign(1, seed);
        std::size_t turnedCount = 0;
        for (std::size_t i = 0; i < component.size(); ++i) {
            for (std::uint32_t side = 0; side < 3; ++side) {
                const SurfaceCorner e = cornerAt(component[i], side);
                if (!across[e].isValid() || reached[faceOf(across[e])] != 0) continue;
                const SurfaceFaceNumber neighbour = faceOf(across[e]);
                reached[neighbour] = 1;
                if (surface.forward(e) == surface.forward(across[e])) {
                    surface.turned[neighbour] = 1;
                    ++turnedCount;
                }
                component.push_back(neighbour);
            }
        }
        const bool turnOthers = 2 * turnedCount > component.size();
        for (const SurfaceFaceNumber face : component) {
            if (turnOthers) surface.turned[face] ^= 1;
            if (surface.turned[face] != 0) surface.repaired[face] |= turnedRepair;
        }
    }
}

glm::dvec3 faceNormal(const PairedSurface& surface, SurfaceFaceNumber face) {
    const auto point = [&](std::uint32_t i) { return surface.points[surface.at[cornerAt(face, i)]]; };
    glm::dvec3 normal = glm::cross(point(1) - point(0), point(2) - point(0));
    if (surface.turned[face] != 0) normal = -normal;
    const double length = glm::length(normal);
    return length > 0 ? normal / length : glm::dvec3(0);
}

// Pairs the half-edges at one edge. Criteria in this order: same primitive, smallest angle between the face normals,
// input order. A face and its reverse are paired only if no other face at the edge remains for either of them.
void pairEdges(PairedSurface& surface, std::span<const SurfaceCorner> edges) {
    struct Candidate {
        double score;
        SurfaceCorner forward, backward;
    };
    std::vector<Candidate> candidates;
    const bool tooMany = edges.size() > maxFacesToPair;
    for (const SurfaceCorner a : tooMany ? std::span<const SurfaceCorner>() : edges) {
        if (!surface.forward(a)) continue;
        const glm::dvec3 normal = faceNormal(surface, faceOf(a));
        for (const SurfaceCorner b : edges) {
            if (surface.forward(b)) continue;
            double score = glm::dot(normal, faceNormal(surface, faceOf(b)));
            if (surface.primitives[faceOf(a)] == surface.primitives[faceOf(b)]) score += 4;
            if (surface.at[previousCorner(a)] == surface.at[previousCorner(b)]) score -= 16;
            candidates.push_back({score, a, b});
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    for (const Candidate& candidate : candidates) {
        if (surface.twins[candidate.forward].isValid() || surface.twins[candidate.backward].isValid()) continue;
        surface.twins[candidate.forward] = candidate.backward;
        surface.twins[candidate.backward] = candidate.forward;
    }
    for (const SurfaceCorner edge : edges)
        if (!surface.twins[edge].isValid()) surface.repaired[faceOf(edge)] |= cutRepair;
}

void pairAllEdges(PairedSurface& surface, const EdgeGroups& groups) {
    for (std::size_t g = 0; g < groups.count(); ++g) {
        const std::span<const SurfaceCorner> edges = groups[g];
        if (edges.size() == 1) continue;
        if (edges.size() == 2 && surface.forward(edges[0]) != surface.forward(edges[1])) {
            surface.twins[edges[0]] = edges[1];
            surface.twins[edges[1]] = edges[0];
        } else {
            pairEdges(surface, edges);
        }
    }
}

// Assigns one vertex to each fan of faces: corners of paired half-edges share a vertex. Uses union-find with the
// smallest corner as root.
void numberVertices(PairedSurface& surface, Manifold& manifold) {
    Numbered<SurfaceCorner, SurfaceCorner> parent(surface.at.size());
    for (const SurfaceCorner corner : parent.numbers()) parent[corner] = corner;
    const auto root = [&](SurfaceCorner corner) {
        while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
        return corner;
    };
    for (const SurfaceCorner e : surface.at.numbers()) {
        const SurfaceCorner twin = surface.twins[e];
        if (!twin.isValid() || twin < e) continue;
        for (const SurfaceCorner mine : {e, nextCorner(e)}) {
            const SurfaceCorner theirs = surface.at[mine] == surface.at[twin] ? twin : nextCorner(twin);
            const SurfaceCorner a = root(mine);
            const SurfaceCorner b = root(theirs);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }

    manifold.corners.resize(surface.at.size());
    Numbered<PositionNumber, std::uint8_t> taken(surface.points.size(), 0);  // 1: the position has a vertex
    Numbered<SurfaceVertexNumber, std::uint8_t> further;                     // 1: not the first vertex at its position
    for (const SurfaceCorner corner : surface.at.numbers()) {
        const SurfaceCorner fan = root(corner);
        if (fan == corner) {
            manifold.corners[corner] = manifold.positions.next();
            manifold.positions.push_back(surface.at[corner]);
            further.push_back(taken[surface.at[corner]]);
            taken[surface.at[corner]] = 1;
        }
        manifold.corners[corner] = manifold.corners[fan];
        if (further[manifold.corners[corner]] != 0) surface.repaired[faceOf(corner)] |= splitRepair;
    }
}

Repairs countedRepairs(const PairedSurface& surface, std::size_t inputFaces) {
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

TriangleSet<PositionNumber> weldedTriangles(const TriangleSet<MeshVertexNumber>& triangles,
                                            const WeldedPositions& positions,
                                            const Numbered<PositionNumber, glm::dvec3>& points) {
    TriangleSet<PositionNumber> welded;
    welded.primitiveIndexCounts = triangles.primitiveIndexCounts;
    welded.indices.reserve(triangles.indices.size());
    for (const TriangleNumber triangle : triangles.numbers()) {
        const auto v = triangles.corners(triangle);
        const PositionNumber p[3] = {positions.id[v[0]], positions.id[v[1]], positions.id[v[2]]};
        const glm::dvec3 sum = points[p[0]] + points[p[1]] + points[p[2]];
        const bool proper = std::isfinite(sum.x + sum.y + sum.z);
        for (const PositionNumber corner : p) welded.indices.push_back(proper ? corner : p[0]);
    }
    return welded;
}

Manifold buildManifold(const TriangleSet<PositionNumber>& triangles,
                       const Numbered<PositionNumber, glm::dvec3>& points) {
    Manifold manifold;
    const Numbered<TriangleNumber, PrimitiveNumber> primitives = primitivesOf(triangles);
    manifold.faces = properFaces(triangles, primitives, points.size());
    const std::size_t count = manifold.faces.size();
    PairedSurface surface{points, {}, {}, {}, {}, {}};
    surface.turned.assign(count, 0);
    surface.repaired.assign(count, 0);
    surface.twins.resize(3 * count);
    surface.at.reserve(3 * count);
    surface.primitives.reserve(count);
    for (const TriangleNumber triangle : manifold.faces) {
        for (const PositionNumber p : triangles.corners(triangle)) surface.at.push_back(p);
        surface.primitives.push_back(primitives[triangle]);
    }

    const EdgeGroups groups = groupEdges(surface);
    orient(surface, groups);
    pairAllEdges(surface, groups);
    numberVertices(surface, manifold);

    manifold.turned = std::move(surface.turned);
    manifold.twins = std::move(surface.twins);
    manifold.repairs = countedRepairs(surface, triangles.count());
    return manifold;
}

Repairs repairsOf(const Mesh& mesh) {
    TriangleSet<MeshVertexNumber> triangles;
    triangles.indices.reserve(3 * mesh.triangleCount());
    for (const Primitive& primitive : mesh.primitives) {
        const std::size_t count = primitive.indices.size() / 3 * 3;
        for (std::size_t i = 0; i < count; ++i) triangles.indices.push_back({primitive.indices[i]});
        triangles.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(count));
    }
    const WeldedPositions positions = weldPositions(mesh.vertices.positions);
    Numbered<PositionNumber, glm::dvec3> points;
    points.reserve(positions.first.size());
    for (const MeshVertexNumber v : positions.first) points.emplace_back(mesh.vertices.positions[v.value]);
    return buildManifold(weldedTriangles(triangles, positions, points), points).repairs;
}

}  // namespace defocus::engine
