// Where do the mesh's vertices lie on what is left of it? Every vertex that is gone has a survivor, near which the
// level's closest face is looked for.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lod/simplify_state.h"
#include "lod/triangle_distance.h"

namespace defocus {

namespace {

constexpr std::size_t mostSteps = 12;  // vertices whose faces are looked at, on the way to the closest face

std::uint32_t survivorOf(Simplifier& s, std::uint32_t v) {
    while (s.survivors[v] != v) v = s.survivors[v] = s.survivors[s.survivors[v]];
    return v;
}

bool looksAlong(const Simplifier& s, const std::uint32_t* corner, const glm::dvec3& side) {
    const glm::dvec3& a = s.points[corner[0]];
    return glm::dot(glm::cross(s.points[corner[1]] - a, s.points[corner[2]] - a), side) > 0;
}

struct Closest {
    double squaredDistance = 0;
    glm::dvec3 point{0};
    std::uint32_t face = EdgeSide::none;  // none: the vertex itself is the closest point
};

// The corner of `face` nearest to `p` that isn't among `seen`; EdgeSide::none if all are.
std::uint32_t nearestUnseen(const Simplifier& s, std::uint32_t face, const glm::dvec3& p,
                            std::span<const std::uint32_t> seen) {
    std::uint32_t nearest = EdgeSide::none;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
        const std::uint32_t v = s.corners.vertex[corner];
        if (std::find(seen.begin(), seen.end(), v) != seen.end()) continue;
        const glm::dvec3 offset = p - s.points[v];
        if (const double distance = glm::dot(offset, offset); distance < least) {
            least = distance;
            nearest = v;
        }
    }
    return nearest;
}

// The point of the level's surface closest to vertex `v`, near its survivor: from the faces around one vertex to those
// around the corners of the closest, as long as that leads closer.
// Only faces that look to `side` count: a thin fin has two sides in one place.
Closest closestTo(Simplifier& s, std::uint32_t v, const glm::dvec3& side) {
    Closest result;
    const glm::dvec3& p = s.points[v];
    std::uint32_t nearest = survivorOf(s, v);
    double least = glm::dot(p - s.points[nearest], p - s.points[nearest]);
    std::array<std::uint32_t, mostSteps> seen;
    for (std::size_t step = 0; step < mostSteps && least > 0 && nearest != EdgeSide::none; ++step) {
        seen[step] = nearest;
        facesAround(s, vertexHandle(nearest), s.facesFrom);
        for (const std::uint32_t face : s.facesFrom) {
            const std::uint32_t* corner = &s.corners.vertex[3 * std::size_t{face}];
            const glm::dvec3 point = closestPoint(p, s.points[corner[0]], s.points[corner[1]], s.points[corner[2]]);
            const glm::dvec3 offset = p - point;
            const double distance = glm::dot(offset, offset);
            if (!(distance < least)) continue;  // NaN of a degenerate face is passed over
            if (!looksAlong(s, corner, side)) continue;
            least = distance;
            result.point = point;
            result.face = face;
        }
        if (result.face == EdgeSide::none) break;
        nearest = nearestUnseen(s, result.face, p, std::span(seen.data(), step + 1));
    }
    result.squaredDistance = least;
    return result;
}

// Barycentric coordinates of `p`, a point of the triangle.
glm::vec3 barycentric(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    if (!(area > 0)) return glm::vec3(1, 0, 0);
    const double u = std::clamp(glm::dot(glm::cross(c - b, p - b), normal) / area, 0.0, 1.0);
    const double v = std::clamp(glm::dot(glm::cross(a - c, p - c), normal) / area, 0.0, 1.0 - u);
    return {u, v, 1 - u - v};
}

}  // namespace

std::vector<Anchor> anchors(Simplifier& s, const std::vector<std::uint32_t>& wedges) {
    std::vector<Anchor> result(s.firstCorner.size());
    for (std::uint32_t wedge = 0; wedge < result.size(); ++wedge) {
        if (s.firstCorner[wedge] == EdgeSide::none) continue;
        Anchor& anchor = result[wedge];
        const glm::dvec3 side = s.corners.attributes[wedge].normal;
        const Closest closest = closestTo(s, s.firstVertex[wedge], side);
        if (closest.face == EdgeSide::none) {
            if (closest.squaredDistance == 0) anchor = {{wedge, wedge, wedge}, {1, 0, 0}};
            continue;
        }
        if (s.corners.primitive[closest.face] != s.corners.primitive[s.firstCorner[wedge] / 3]) continue;
        const std::size_t corner = 3 * std::size_t{closest.face};
        const std::uint32_t* v = &s.corners.vertex[corner];
        const glm::vec3 weights = barycentric(closest.point, s.points[v[0]], s.points[v[1]], s.points[v[2]]);
        for (int k = 0; k < 3; ++k) {
            anchor.vertex[k] = wedges[corner + static_cast<std::size_t>(k)];
            anchor.weight[k] = weights[k];
        }
    }
    return result;
}

}  // namespace defocus
