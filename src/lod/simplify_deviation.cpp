// How far is what is left from the mesh? Every vertex that is gone has a survivor, near which the level's closest face
// is looked for: what is found bounds the vertex's distance to the level. The 99th percentile over a sample of the
// vertices stands for the level.

#include <algorithm>
#include <cmath>

#include "lod/simplify_state.h"
#include "lod/triangle_distance.h"

namespace defocus {

namespace {

constexpr std::size_t mostSamples = 4096;  // vertices looked at a level
constexpr int mostSteps = 8;               // from vertex to vertex towards the closest face
constexpr double percentile = 0.99;

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
    std::uint32_t vertex = 0;             // that the walk ended at
    std::uint32_t face = EdgeSide::none;  // none: the vertex itself is the closest point
};

// The point of the level's surface closest to vertex `v`, near its survivor: from vertex to vertex as long as that
// leads closer.
// With a `side`, only faces that look that way count: a thin fin has two sides in one place.
Closest closestTo(Simplifier& s, std::uint32_t v, const glm::dvec3* side = nullptr) {
    Closest result;
    const glm::dvec3& p = s.points[v];
    std::uint32_t nearest = survivorOf(s, v);
    double least = glm::dot(p - s.points[nearest], p - s.points[nearest]);
    for (int step = 0; step < mostSteps && least > 0; ++step) {
        facesAround(s, vertexHandle(nearest), s.facesFrom);
        std::uint32_t closestFace = EdgeSide::none;
        for (const std::uint32_t face : s.facesFrom) {
            const std::uint32_t* corner = &s.corners.vertex[3 * std::size_t{face}];
            const glm::dvec3 point = closestPoint(p, s.points[corner[0]], s.points[corner[1]], s.points[corner[2]]);
            const glm::dvec3 offset = p - point;
            const double distance = glm::dot(offset, offset);
            if (!(distance < least)) continue;  // NaN of a degenerate face is passed over
            if (side != nullptr && !looksAlong(s, corner, *side)) continue;
            least = distance;
            closestFace = face;
            result.point = point;
            result.face = face;
        }
        if (closestFace == EdgeSide::none) break;
        const auto distanceTo = [&](std::uint32_t corner) {
            return glm::distance(p, s.points[s.corners.vertex[corner]]);
        };
        std::uint32_t next = 3 * closestFace;
        for (std::uint32_t corner = next + 1; corner < 3 * closestFace + 3; ++corner)
            if (distanceTo(corner) < distanceTo(next)) next = corner;
        if (s.corners.vertex[next] == nearest) break;
        nearest = s.corners.vertex[next];
    }
    result.squaredDistance = least;
    result.vertex = nearest;
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

double deviation(Simplifier& s) {
    std::vector<double> squaredDistances;
    const std::size_t stride = std::max<std::size_t>(1, s.points.size() / mostSamples);
    for (std::size_t v = 0; v < s.points.size(); v += stride)
        squaredDistances.push_back(closestTo(s, static_cast<std::uint32_t>(v)).squaredDistance);
    const auto rank = static_cast<std::ptrdiff_t>(percentile * static_cast<double>(squaredDistances.size() - 1));
    std::nth_element(squaredDistances.begin(), squaredDistances.begin() + rank, squaredDistances.end());
    return std::sqrt(squaredDistances[static_cast<std::size_t>(rank)]) * s.scale;
}

std::vector<Anchor> anchors(Simplifier& s) {
    std::vector<Anchor> result(s.firstCorner.size());
    for (std::uint32_t wedge = 0; wedge < result.size(); ++wedge) {
        if (s.firstCorner[wedge] == EdgeSide::none) continue;
        Anchor& anchor = result[wedge];
        const glm::dvec3 side = s.corners.attributes[wedge].normal;
        const Closest closest = closestTo(s, s.firstVertex[wedge], &side);
        if (closest.face == EdgeSide::none) {
            if (closest.squaredDistance == 0) anchor = {{wedge, wedge, wedge}, {1, 0, 0}};
            continue;
        }
        if (s.corners.primitive[closest.face] != s.corners.primitive[s.firstCorner[wedge] / 3]) continue;
        const std::size_t corner = 3 * std::size_t{closest.face};
        const std::uint32_t* v = &s.corners.vertex[corner];
        const glm::vec3 weights = barycentric(closest.point, s.points[v[0]], s.points[v[1]], s.points[v[2]]);
        for (int k = 0; k < 3; ++k) {
            anchor.vertex[k] = s.corners.wedge[corner + static_cast<std::size_t>(k)];
            anchor.weight[k] = weights[k];
        }
    }
    return result;
}

}  // namespace defocus
