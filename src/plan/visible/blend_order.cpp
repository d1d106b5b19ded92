#include "plan/visible/blend_order.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "core/bounds.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxTriangles = 1000;  // of a primitive that isConvex() tests
constexpr double tolerance = 1e-4;          // of the primitive's size; rounding of flat and round shapes

bool blends(const Scene& scene, const Primitive& primitive) {
    return primitive.material >= 0 &&
           scene.materials[static_cast<std::size_t>(primitive.material)].alphaMode == AlphaMode::blend;
}

// Returns whether the object's surfaces have one order in depth from every viewpoint.
bool hasOneOrder(const ObjectPlan& object, const Scene& scene) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
    if (object.deformed || object.skinned) return false;
    const Primitive* only = nullptr;
    for (const Primitive& primitive : mesh.primitives) {
        if (!blends(scene, primitive)) continue;
        if (only != nullptr) return false;
        only = &primitive;
    }
    return only != nullptr && isConvex(mesh.vertices, *only);
}

// Rectangle of the image in px, relative to its centre, that all lens samples' images of the object lie in.
struct Place {
    glm::dvec2 low{0}, high{0};
    bool known = false;  // false: the object reaches the near plane
};

Place placeOf(const ObjectPlan& object, const FramePlan& plan) {
    Place place;
    place.known = object.nearestDepth > plan.view.nearPlane;
    if (!place.known) return place;
    const double pixels = 0.5 * plan.view.width / plan.tanHalfHorizontal;
    const double margin = 1 + 0.5 * object.coc.largest;
    const Bounds& box = object.viewBox;
    place.low = glm::dvec2(std::numeric_limits<double>::infinity());
    place.high = -place.low;
    for (const double depth : {object.nearestDepth, object.farthestDepth})
        for (const glm::dvec2& corner : {glm::dvec2(box.minimum), glm::dvec2(box.maximum)}) {
            place.low = glm::min(place.low, corner * (pixels / depth) - margin);
            place.high = glm::max(place.high, corner * (pixels / depth) + margin);
        }
    return place;
}

// Returns whether the order of the objects' nearest depths is right wherever they overlap in the image.
bool areOrdered(const ObjectPlan& a, const ObjectPlan& b, const FramePlan& plan) {
    if (a.farthestDepth <= b.nearestDepth || b.farthestDepth <= a.nearestDepth) return true;
    const Place p = placeOf(a, plan);
    const Place q = placeOf(b, plan);
    if (!p.known || !q.known) return false;
    return p.high.x < q.low.x || q.high.x < p.low.x || p.high.y < q.low.y || q.high.y < p.low.y;
}

}  // namespace

bool isConvex(const Vertices& vertices, const Primitive& primitive) {
    const std::vector<std::uint32_t>& indices = primitive.indices;
    if (indices.size() > 3 * maxTriangles) return false;
    std::vector<std::uint32_t> used = indices;
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    Bounds box;
    for (const std::uint32_t i : used) box.extend(glm::dvec3(vertices.positions[i]));
    if (box.empty()) return true;
    const double above = tolerance * glm::length(box.maximum - box.minimum);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 corner = vertices.positions[indices[i]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(vertices.positions[indices[i + 1]]) - corner,
                                             glm::dvec3(vertices.positions[indices[i + 2]]) - corner);
        const double limit = above * glm::length(normal);
        for (const std::uint32_t j : used)
            if (!(glm::dot(normal, glm::dvec3(vertices.positions[j]) - corner) <= limit)) return false;
    }
    return true;
}

void chooseBlending(FramePlan& plan, const World& world) {
    const Scene& scene = *world.scene;
    std::vector<const ObjectPlan*> sorted;
    for (ObjectPlan& object : plan.objects) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
        object.blended = std::ranges::any_of(mesh.primitives, [&](const Primitive& p) { return blends(scene, p); });
        if (!object.blended) continue;
        const auto isOrdered = [&](const ObjectPlan* other) { return areOrdered(object, *other, plan); };
        object.stochasticAlpha = !hasOneOrder(object, scene) || !std::ranges::all_of(sorted, isOrdered);
        if (!object.stochasticAlpha) sorted.push_back(&object);
    }
}

}  // namespace defocus::engine
