// Where do the mesh's vertices lie on what is left of it? Every vertex that is gone has a survivor, near which the
// level's closest face is looked for.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>

#include "lod/simplify/state.h"
#include "lod/simplify/triangle_distance.h"

namespace defocus {

namespace {

constexpr std::size_t mostSteps = 12;  // vertices whose faces are looked at, on the way to the closest face
constexpr double noDistance = 1e-24;   // squared, where the mesh is about 1 wide: rounding
constexpr double leastUpright = 0.99;  // squared cosine of the angle between a face's normal and the way straight up
constexpr std::uint32_t noCorner = 0xffffffffu;
// Of the vertices that have collapsed onto one, at least so many are looked for: each second, fourth … of more.
constexpr std::uint32_t enoughAnchors = 16;

// The level's faces, and whose corners lie at each vertex.
struct FaceRings {
    const Snapshot& level;
    std::vector<glm::dvec3> points;    // of the vertices, in the frame
    std::vector<glm::dvec3> normals;   // of the faces, as long as twice the area
    std::vector<std::uint32_t> first;  // of each vertex, into `corners`
    std::vector<std::uint32_t> corners;

    [[nodiscard]] std::span<const std::uint32_t> around(VertexHandle v) const {
        return std::span(corners).subspan(first[indexOf(v)], first[indexOf(v) + 1] - first[indexOf(v)]);
    }
    [[nodiscard]] const glm::dvec3& point(VertexHandle v) const { return points[indexOf(v)]; }
    [[nodiscard]] const glm::dvec3& point(std::size_t corner) const { return point(level.corners[corner]); }
};

FaceRings faceRings(const Snapshot& level, const Frame& frame) {
    FaceRings rings{level, {}, {}, {}, {}};
    rings.points.reserve(level.positions.size());
    for (const glm::vec3& position : level.positions) rings.points.push_back(frame.point(position));
    const std::vector<VertexHandle>& corners = level.corners;
    rings.first.assign(level.positions.size() + 1, 0);
    for (const VertexHandle v : corners) ++rings.first[indexOf(v) + 1];
    std::partial_sum(rings.first.begin(), rings.first.end(), rings.first.begin());
    rings.corners.resize(corners.size());
    std::vector<std::uint32_t> next(rings.first.begin(), rings.first.end() - 1);
    rings.normals.reserve(corners.size() / 3);
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        rings.corners[next[indexOf(corners[corner])]++] = static_cast<std::uint32_t>(corner);
        if (corner % 3 != 0) continue;
        const glm::dvec3& a = rings.point(corner);
        rings.normals.push_back(glm::cross(rings.point(corner + 1) - a, rings.point(corner + 2) - a));
    }
    return rings;
}

struct Closest {
    double squaredDistance = 0;
    std::uint32_t corner = noCorner;  // of the face; none: the vertex itself is the closest point
    glm::dvec2 along{0};              // see closestCoordinates; from the corner to the next and the previous one
};

// The corner of `face` nearest to `p` that isn't among `seen`; invalid if all are.
VertexHandle nearestUnseen(const FaceRings& rings, std::uint32_t face, const glm::dvec3& p,
                           std::span<const VertexHandle> seen) {
    VertexHandle nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t corner = 3 * std::size_t{face}; corner < 3 * std::size_t{face} + 3; ++corner) {
        const VertexHandle v = rings.level.corners[corner];
        if (std::find(seen.begin(), seen.end(), v) != seen.end()) continue;
        const glm::dvec3 offset = p - rings.point(corner);
        if (const double distance = glm::dot(offset, offset); distance < least) {
            least = distance;
            nearest = v;
        }
    }
    return nearest;
}

// Does the face lie straight below a point that is `offset` away from its point `along`? The coordinates alone don't
// tell: those of a sliver are mostly rounding.
bool liesBelow(const FaceRings& rings, std::uint32_t face, const glm::dvec2& along, const glm::dvec3& offset) {
    if (!(along.x > 0 && along.y > 0 && along.x + along.y < 1)) return false;
    const glm::dvec3& normal = rings.normals[face];
    const double height = glm::dot(offset, normal);
    return height * height >= leastUpright * glm::dot(offset, offset) * glm::dot(normal, normal);
}

// The point of the level's surface closest to `p`, near the vertex `start`: from the faces around one vertex to those
// around the corners of the closest, as long as that leads closer and no face lies straight below.
// Only faces that look to `side` count: a thin fin has two sides in one place.
Closest closestTo(const FaceRings& rings, const glm::dvec3& p, VertexHandle start, const glm::dvec3& side) {
    Closest result;
    VertexHandle nearest = start;
    const glm::dvec3 away = p - rings.point(start);
    bool below = false;
    double least = glm::dot(away, away);
    std::array<VertexHandle, mostSteps> seen;
    for (std::size_t step = 0; step < mostSteps && nearest.is_valid(); ++step) {
        if (least <= (result.corner == noCorner ? 0 : noDistance)) break;
        seen[step] = nearest;
        const glm::dvec3& a = rings.point(nearest);
        const glm::dvec3 fromA = p - a;
        for (const std::uint32_t corner : rings.around(nearest)) {
            const glm::dvec3& b = rings.point(nextCorner(corner));
            const glm::dvec3& c = rings.point(previousCorner(corner));
            if (glm::dot(b - a, fromA) <= 0 && glm::dot(c - a, fromA) <= 0) continue;  // closest at the vertex itself
            const std::uint32_t face = corner / 3;
            if (!(glm::dot(rings.normals[face], side) > 0)) continue;
            const glm::dvec2 along = closestCoordinates(p, a, b, c);
            const glm::dvec3 offset = fromA - along.x * (b - a) - along.y * (c - a);
            const double distance = glm::dot(offset, offset);
            if (!(distance < least)) continue;  // NaN of a degenerate face is passed over
            least = distance;
            result.along = along;
            result.corner = corner;
            below = liesBelow(rings, face, along, offset);
            if (below) break;
        }
        if (result.corner == noCorner || below) break;
        nearest = nearestUnseen(rings, result.corner / 3, p, std::span(seen.data(), step + 1));
    }
    result.squaredDistance = least;
    return result;
}

// For each vertex of the level, of how many mesh vertices that have collapsed onto it one is enough.
std::vector<std::uint32_t> anchorStrides(const Origin& origin, const Snapshot& level) {
    std::vector<std::uint32_t> strides(level.positions.size(), 0);
    for (const VertexHandle v : origin.firstVertex)
        if (v.is_valid() && level.nearest[indexOf(v)].is_valid()) ++strides[indexOf(level.nearest[indexOf(v)])];
    for (std::uint32_t& stride : strides) stride = std::bit_floor(std::max(1u, stride / enoughAnchors));
    return strides;
}

}  // namespace

std::vector<Anchor> anchors(const Origin& origin, const Snapshot& level) {
    const FaceRings rings = faceRings(level, origin.frame);
    std::vector<std::uint32_t> cornerOf(origin.firstVertex.size(), noCorner);  // of each of the mesh's vertices
    const std::vector<std::uint32_t>& drawn = level.drawn.indices;
    for (std::uint32_t corner = 0; corner < drawn.size(); ++corner)
        if (drawn[corner] < cornerOf.size()) cornerOf[drawn[corner]] = corner;
    std::vector<std::uint32_t> firstFaces = {0};  // of each primitive
    for (const std::uint32_t count : level.drawn.primitiveIndexCounts)
        firstFaces.push_back(firstFaces.back() + count / 3);

    std::vector<Anchor> result(origin.firstVertex.size());
    const std::vector<std::uint32_t> strides = anchorStrides(origin, level);
    std::vector<std::uint32_t> waiting(strides.size(), 0);
    for (std::uint32_t own = 0; own < result.size(); ++own) {
        const VertexHandle v = origin.firstVertex[own];
        if (!v.is_valid()) continue;
        Anchor& anchor = result[own];
        const VertexHandle survivor = level.nearest[indexOf(v)];
        if (!survivor.is_valid()) continue;
        const std::uint32_t stride = strides[indexOf(survivor)];
        if (waiting[indexOf(survivor)]++ % stride != 0) continue;
        anchor.count = static_cast<float>(stride);
        const glm::dvec3 side = origin.vertices.normals[own];
        const Closest closest = closestTo(rings, origin.frame.point(origin.vertices.positions[own]), survivor, side);
        if (closest.corner == noCorner) {
            const std::uint32_t corner = cornerOf[own];
            if (closest.squaredDistance != 0 || corner == noCorner) continue;
            anchor.triangle = corner / 3;
            anchor.weight[corner % 3] = 1;
            continue;
        }
        const std::uint32_t primitive = origin.firstPrimitive[own].value;
        const std::uint32_t face = closest.corner / 3;
        if (face < firstFaces[primitive] || face >= firstFaces[primitive + 1]) continue;
        anchor.triangle = face;
        anchor.weight[closest.corner % 3] = static_cast<float>(1 - closest.along.x - closest.along.y);
        anchor.weight[nextCorner(closest.corner) % 3] = static_cast<float>(closest.along.x);
        anchor.weight[previousCorner(closest.corner) % 3] = static_cast<float>(closest.along.y);
    }
    return result;
}

}  // namespace defocus
