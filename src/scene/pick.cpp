// Sources: ray–triangle intersection of Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997;
// slab test for boxes of Kay and Kajiya, "Ray Tracing Complex Scenes", 1986.
#include "scene/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "core/morton_order.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  // of any length; the point at ray parameter t is origin + t · direction
};

bool reaches(const Ray& ray, const Bounds& box, double farthest) {
    double enter = 0;
    double leave = farthest;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) {
            if (ray.origin[axis] < box.minimum[axis] || ray.origin[axis] > box.maximum[axis]) return false;
            continue;
        }
        double first = (box.minimum[axis] - ray.origin[axis]) / ray.direction[axis];
        double second = (box.maximum[axis] - ray.origin[axis]) / ray.direction[axis];
        if (first > second) std::swap(first, second);
        // Widen the interval slightly so that rounding never rejects a triangle that lies in a face of the box.
        enter = std::max(enter, first - 1e-12 * std::abs(first));
        leave = std::min(leave, second + 1e-12 * std::abs(second));
    }
    return enter <= leave;
}

// Returns the ray parameter at which the ray hits triangle abc from either side; infinity if the ray misses the
// triangle.
double crossing(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double miss = std::numeric_limits<double>::infinity();
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return miss;
    const glm::dvec3 fromA = ray.origin - a;
    const double u = glm::dot(fromA, p) / determinant;
    const glm::dvec3 q = glm::cross(fromA, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 ? t : miss;
}

// Vertex indices of a triangle's corners.
using Corners = std::array<std::uint32_t, 3>;

// Triangles of a mesh. For many rays, they are sorted so that `groupSize` consecutive triangles lie close together; a
// ray that misses the bounding box of such a group is not tested against its triangles.
struct TriangleGroups {
    std::vector<Corners> triangles;
    Bounds bounds;              // bounding box of all triangles
    std::vector<Bounds> boxes;  // bounding boxes of the groups; empty if each ray is tested against all triangles
};

constexpr std::size_t groupSize = 16;
constexpr std::size_t minRaysForGroups = 8;  // for fewer rays, sorting takes longer than it saves

// Sorts the triangles in Morton order. `place(index)` returns the position of vertex `index`.
template <typename Place>
void sortInSpace(TriangleGroups& groups, const Place& place) {
    const glm::dvec3 size = groups.bounds.size();
    const double cells = maxMortonCell / std::max({size.x, size.y, size.z});  // grid cells per unit of length
    LargeVector<std::uint64_t> keys;  // Morton code in the upper 32 bits, index of the triangle in the lower 32 bits
    keys.reserve(groups.triangles.size());
    for (const Corners& corners : groups.triangles) {
        const glm::dvec3 centre = (place(corners[0]) + place(corners[1]) + place(corners[2])) / 3.0;
        const std::uint32_t code = mortonCode((centre - glm::dvec3(groups.bounds.minimum)) * cells);
        keys.push_back(std::uint64_t{code} << 32 | keys.size());
    }
    sortByMortonCode(keys);
    std::vector<Corners> sorted;
    sorted.reserve(keys.size());
    for (const std::uint64_t key : keys) sorted.push_back(groups.triangles[key & 0xffffffffu]);
    groups.triangles = std::move(sorted);
}

// Returns the mesh's triangles, sorted and grouped if `rays`, the number of rays to trace, is large enough.
// `place(index)` returns the position of vertex `index`.
template <typename Place>
TriangleGroups groupsOf(const Mesh& mesh, std::size_t rays, const Place& place) {
    TriangleGroups groups;
    groups.triangles.reserve(mesh.triangleCount());
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
            groups.triangles.push_back({primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]});
    for (const Corners& corners : groups.triangles)
        for (const std::uint32_t corner : corners) groups.bounds.extend(place(corner));
    if (rays < minRaysForGroups) return groups;
    sortInSpace(groups, place);
    for (std::size_t i = 0; i < groups.triangles.size(); ++i) {
        if (i % groupSize == 0) groups.boxes.emplace_back();
        for (const std::uint32_t corner : groups.triangles[i]) groups.boxes.back().extend(place(corner));
    }
    return groups;
}

// Returns the ray parameter of the first hit on a triangle, or `nearest` if that is smaller. `boxes`: groups.boxes, or
// empty to test all triangles. `place(index)` returns the position of vertex `index`.
template <typename Place>
double nearestCrossing(const TriangleGroups& groups, std::span<const Bounds> boxes, const Ray& ray, double nearest,
                       const Place& place) {
    const std::size_t size = boxes.empty() ? groups.triangles.size() : groupSize;
    for (std::size_t start = 0; start < groups.triangles.size(); start += size) {
        if (!boxes.empty() && !reaches(ray, boxes[start / groupSize], nearest)) continue;
        for (std::size_t i = start; i < std::min(start + size, groups.triangles.size()); ++i) {
            const auto [a, b, c] = groups.triangles[i];
            nearest = std::min(nearest, crossing(ray, place(a), place(b), place(c)));
        }
    }
    return nearest;
}

auto placesOf(const Mesh& mesh) {
    return [&mesh](std::uint32_t vertex) { return glm::dvec3(mesh.vertices.positions[vertex]); };
}

// Returns the ray parameter of the first hit on an undeformed object, or `nearest` if that is smaller. The ray is
// transformed to object space if the object's matrix is invertible; otherwise the triangles are transformed to world
// space. `groups`: the mesh's triangles.
double nearestCrossing(const Mesh& mesh, const TriangleGroups& groups, const glm::dmat4& worldFromObject,
                       const glm::dmat4& objectFromWorld, const Ray& world, double nearest) {
    const Ray ray{glm::dvec3(objectFromWorld * glm::dvec4(world.origin, 1)),
                  glm::dvec3(objectFromWorld * glm::dvec4(world.direction, 0))};
    const bool invertible = std::isfinite(glm::dot(ray.origin, ray.origin)) &&
                            std::isfinite(glm::dot(ray.direction, ray.direction)) &&
                            glm::dot(ray.direction, ray.direction) > 0;
    if (invertible) return nearestCrossing(groups, groups.boxes, ray, nearest, placesOf(mesh));
    return nearestCrossing(groups, {}, world, nearest, [&](std::uint32_t vertex) {
        return glm::dvec3(worldFromObject * glm::dvec4(mesh.vertices.positions[vertex], 1));
    });
}

// Bounding sphere in world space.
struct Ball {
    glm::dvec3 centre;
    double radius;
};

Ball ballAround(const Bounds& bounds, const glm::dmat4& worldFromBounds) {
    const glm::dvec3 half = 0.5 * bounds.size();
    double radius = 0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        radius += half[axis] * glm::length(glm::dvec3(worldFromBounds[axis]));
    return {glm::dvec3(worldFromBounds * glm::dvec4(bounds.centre(), 1)), radius};
}

// Returns true only if the ray misses the ball even with rounding errors. The ray's direction must have unit length.
bool misses(const Ray& ray, const Ball& ball) {
    constexpr double rounding = 1e-12;
    const glm::dvec3 toCentre = ball.centre - ray.origin;
    const double along = std::max(0.0, glm::dot(toCentre, ray.direction));
    const double square = glm::dot(toCentre, toCentre);
    return square - along * along > ball.radius * ball.radius * (1 + rounding) + rounding * square;
}

// Triangles of one object, prepared for intersection with many rays.
class Target {
public:
    // `undeformed`: triangles of the undeformed mesh. `rays`: number of rays that will be traced.
    Target(const Mesh& mesh, const TriangleGroups& undeformed, std::size_t rays, const Object& object)
        : mesh_(mesh), undeformed_(undeformed), object_(object), deformed_(deformed(object)) {
        if (deformed_) {
            positions_ = posedPositions(mesh, object);
            posed_ = groupsOf(mesh, rays, [&](std::uint32_t vertex) { return positions_[vertex]; });
        }
        ball_ = deformed_ ? ballAround(posed_.bounds, glm::dmat4(1))
                          : ballAround(undeformed_.bounds, object.worldFromObject);
        objectFromWorld_ = deformed_ ? glm::dmat4(1) : glm::inverse(object.worldFromObject);
    }

    [[nodiscard]] double nearestCrossing(const Ray& world, double nearest) const {
        if (misses(world, ball_)) return nearest;
        if (!deformed_)
            return engine::nearestCrossing(mesh_, undeformed_, object_.worldFromObject, objectFromWorld_, world,
                                           nearest);
        return engine::nearestCrossing(posed_, posed_.boxes, world, nearest,
                                       [&](std::uint32_t vertex) { return positions_[vertex]; });
    }

private:
    const Mesh& mesh_;
    const TriangleGroups& undeformed_;
    Ball ball_{};
    glm::dmat4 objectFromWorld_{1};
    const Object& object_;
    bool deformed_;
    // Vertex positions and triangles in world space; empty unless the object is deformed.
    std::vector<glm::dvec3> positions_;
    TriangleGroups posed_;
};

}  // namespace

std::vector<std::optional<Hit>> firstHits(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                                          const std::vector<glm::dvec3>& directions) {
    std::vector<Ray> rays;
    for (const glm::dvec3& direction : directions) rays.push_back({origin, glm::normalize(direction)});
    std::vector<Hit> nearest(rays.size(), {std::numeric_limits<double>::infinity(), -1});
    std::vector<TriangleGroups> groups(scene.meshes.size());  // triangles of each mesh; empty until needed
    for (std::size_t i = 0; i < pose.objects.size(); ++i) {
        const Object& object = pose.objects[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        TriangleGroups& undeformed = groups[static_cast<std::size_t>(object.mesh)];
        if (undeformed.triangles.empty()) undeformed = groupsOf(mesh, rays.size(), placesOf(mesh));
        if (undeformed.triangles.empty()) continue;
        const Target target(mesh, undeformed, rays.size(), object);
        for (std::size_t ray = 0; ray < rays.size(); ++ray) {
            const double distance = target.nearestCrossing(rays[ray], nearest[ray].distance);
            if (distance < nearest[ray].distance) nearest[ray] = {distance, static_cast<int>(i)};
        }
    }
    std::vector<std::optional<Hit>> hits(rays.size());
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
        if (nearest[ray].object >= 0) hits[ray] = nearest[ray];
    return hits;
}

std::optional<Hit> firstHit(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                            const glm::dvec3& direction) {
    return firstHits(scene, pose, origin, {direction}).front();
}

}  // namespace defocus::engine
