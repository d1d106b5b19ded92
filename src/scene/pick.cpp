// Sources: ray–triangle intersection of Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997;
// slab test for boxes of Kay and Kajiya, "Ray Tracing Complex Scenes", 1986.
#include "scene/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

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

// A run is a group of up to runLength consecutive triangles of a primitive. A ray that misses the run's bounding box is
// not tested against the triangles.
constexpr std::size_t runLength = 64;

// Returns the bounding boxes of the mesh's runs of triangles. `place(index)` returns the position of vertex `index`.
template <typename Place>
std::vector<Bounds> boxesOfRuns(const Mesh& mesh, const Place& place) {
    std::vector<Bounds> boxes;
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            if (i % (3 * runLength) == 0) boxes.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) boxes.back().extend(place(primitive.indices[i + k]));
        }
    return boxes;
}

// Returns the ray parameter of the first hit of the mesh, or `nearest` if that is smaller. `boxes` are the bounding
// boxes of the mesh's runs of triangles; without boxes, all triangles are tested. `place(index)` returns the position
// of vertex `index`.
template <typename Place>
double nearestCrossing(const Mesh& mesh, const std::vector<Bounds>& boxes, const Ray& ray, double nearest,
                       const Place& place) {
    auto box = boxes.begin();
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t run = 0; run + 2 < primitive.indices.size(); run += 3 * runLength) {
            if (!boxes.empty() && !reaches(ray, *box++, nearest)) continue;
            const std::size_t end = std::min(run + 3 * runLength, primitive.indices.size());
            for (std::size_t i = run; i + 2 < end; i += 3) {
                const auto corner = [&](std::size_t k) { return place(primitive.indices[i + k]); };
                nearest = std::min(nearest, crossing(ray, corner(0), corner(1), corner(2)));
            }
        }
    return nearest;
}

auto placesOf(const Mesh& mesh) {
    return [&mesh](std::uint32_t vertex) { return glm::dvec3(mesh.vertices.positions[vertex]); };
}

// Returns the ray parameter of the first hit of an object that is not deformed, or `nearest` if that is smaller. The
// ray is transformed to object space if the matrix is invertible; otherwise the triangles are transformed to world
// space. `boxes` are the bounding boxes of the mesh's runs of triangles.
double nearestCrossing(const Mesh& mesh, const std::vector<Bounds>& boxes, const glm::dmat4& worldFromObject,
                       const glm::dmat4& objectFromWorld, const Ray& world, double nearest) {
    const Ray ray{glm::dvec3(objectFromWorld * glm::dvec4(world.origin, 1)),
                  glm::dvec3(objectFromWorld * glm::dvec4(world.direction, 0))};
    const bool invertible = std::isfinite(glm::dot(ray.origin, ray.origin)) &&
                            std::isfinite(glm::dot(ray.direction, ray.direction)) &&
                            glm::dot(ray.direction, ray.direction) > 0;
    if (!invertible) {
        return nearestCrossing(mesh, {}, world, nearest, [&](std::uint32_t vertex) {
            return glm::dvec3(worldFromObject * glm::dvec4(mesh.vertices.positions[vertex], 1));
        });
    }
    return nearestCrossing(mesh, boxes, ray, nearest, placesOf(mesh));
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

Bounds unionOf(const std::vector<Bounds>& boxes) {
    Bounds all;
    for (const Bounds& box : boxes) all.extend(box);
    return all;
}

// Triangles of one object, prepared for intersection with many rays.
class Target {
public:
    // `meshBoxes` are the bounding boxes of the runs of triangles of the undeformed mesh.
    Target(const Mesh& mesh, const std::vector<Bounds>& meshBoxes, const Object& object)
        : mesh_(mesh), meshBoxes_(meshBoxes), object_(object), deformed_(deformed(object)) {
        if (deformed_) {
            positions_ = posedPositions(mesh, object);
            posedBoxes_ = boxesOfRuns(mesh, [&](std::uint32_t vertex) { return positions_[vertex]; });
        }
        ball_ = ballAround(unionOf(deformed_ ? posedBoxes_ : meshBoxes_),
                           deformed_ ? glm::dmat4(1) : object.worldFromObject);
        objectFromWorld_ = deformed_ ? glm::dmat4(1) : glm::inverse(object.worldFromObject);
    }

    [[nodiscard]] double nearestCrossing(const Ray& world, double nearest) const {
        if (misses(world, ball_)) return nearest;
        if (!deformed_)
            return engine::nearestCrossing(mesh_, meshBoxes_, object_.worldFromObject, objectFromWorld_, world,
                                           nearest);
        return engine::nearestCrossing(mesh_, posedBoxes_, world, nearest,
                                       [&](std::uint32_t vertex) { return positions_[vertex]; });
    }

private:
    const Mesh& mesh_;
    const std::vector<Bounds>& meshBoxes_;
    Ball ball_{};
    glm::dmat4 objectFromWorld_{1};
    const Object& object_;
    bool deformed_;
    // Vertex positions, and bounding boxes of runs of triangles, in world space; empty unless the object is deformed.
    std::vector<glm::dvec3> positions_;
    std::vector<Bounds> posedBoxes_;
};

}  // namespace

std::vector<std::optional<Hit>> firstHits(const Scene& scene, const Pose& pose, const glm::dvec3& origin,
                                          const std::vector<glm::dvec3>& directions) {
    std::vector<Ray> rays;
    for (const glm::dvec3& direction : directions) rays.push_back({origin, glm::normalize(direction)});
    std::vector<Hit> nearest(rays.size(), {std::numeric_limits<double>::infinity(), -1});
    std::vector<std::vector<Bounds>> boxes(scene.meshes.size());  // of runs of triangles, per mesh; empty until needed
    for (std::size_t i = 0; i < pose.objects.size(); ++i) {
        const Object& object = pose.objects[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        std::vector<Bounds>& meshBoxes = boxes[static_cast<std::size_t>(object.mesh)];
        if (meshBoxes.empty()) meshBoxes = boxesOfRuns(mesh, placesOf(mesh));
        if (meshBoxes.empty()) continue;
        const Target target(mesh, meshBoxes, object);
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
