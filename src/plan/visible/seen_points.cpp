#include "plan/visible/seen_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "core/parallel.h"

namespace defocus::engine {

namespace {

constexpr int rayColumns = 16;  // number of columns of the grid of rays through the image
constexpr int rayRows = 12;
constexpr int rayDepths = 4;              // number of points on the part of a ray inside a bounding box
constexpr std::size_t maxCrossings = 16;  // max boxes along a ray; farther boxes are ignored

// Part of a ray inside the bounding box of an object, with depths in m.
struct Crossing {
    double enter = 0;
    double leave = 0;
    const ObjectPlan* object = nullptr;
};

// Returns where a ray from the camera enters and leaves the object's bounding box; `leave` < `enter` if the ray misses
// the box. `direction` is scaled to a depth of 1 m.
Crossing crossing(const ObjectPlan& object, const glm::dvec3& direction, double nearPlane) {
    Crossing found{nearPlane, std::numeric_limits<double>::infinity(), &object};
    for (int axis = 0; axis < 3; ++axis) {
        double enter = object.viewBox.minimum[axis] / direction[axis];
        double leave = object.viewBox.maximum[axis] / direction[axis];
        if (enter > leave) std::swap(enter, leave);
        found.enter = std::max(found.enter, enter);
        found.leave = std::min(found.leave, leave);
    }
    return found;
}

double blurAt(const FramePlan& plan, const ObjectPlan& object, double depth, const glm::dvec2& ndc) {
    return std::abs(
        circleOfConfusion(plan.coc, depth, plan.view.width, ndc, object.own.factorMin, object.own.addedMin));
}

std::vector<SeenPoint> seenAlong(const FramePlan& plan, const glm::dvec2& ndc) {
    const double tangent = plan.tanHalfHorizontal;
    const glm::dvec3 direction(ndc * tangent * glm::dvec2(1, static_cast<double>(plan.view.height) / plan.view.width),
                               -1);
    std::vector<Crossing> crossings;
    for (const ObjectPlan& object : plan.objects) {
        const Crossing found = crossing(object, direction, plan.view.nearPlane);
        if (found.enter <= found.leave && std::isfinite(found.leave)) crossings.push_back(found);
    }
    if (crossings.size() > maxCrossings) {
        std::ranges::nth_element(crossings, crossings.begin() + maxCrossings, {}, &Crossing::enter);
        crossings.resize(maxCrossings);
    }
    const glm::dmat3 worldFromView(plan.view.worldFromCamera);
    std::vector<SeenPoint> seen;
    for (const Crossing& found : crossings)
        for (int i = 0; i < rayDepths; ++i) {
            const double depth = std::lerp(found.enter, found.leave, (i + 0.5) / rayDepths);
            const double spread = std::max(depth * tangent / rayColumns, (found.leave - found.enter) / (2 * rayDepths));
            seen.push_back(
                {worldFromView * (depth * direction), depth, spread, blurAt(plan, *found.object, depth, ndc)});
        }
    return seen;
}

std::vector<SeenPoint> middles(const FramePlan& plan) {
    const glm::dmat3 worldFromView(plan.view.worldFromCamera);
    std::vector<SeenPoint> seen;
    for (const ObjectPlan& object : plan.objects) {
        const glm::dvec3 middle = object.viewBox.centre();
        const double depth = std::max(-middle.z, plan.view.nearPlane);
        seen.push_back({worldFromView * middle, depth, 0.5 * glm::length(object.viewBox.size()),
                        blurAt(plan, object, depth, glm::dvec2(0))});
    }
    return seen;
}

}  // namespace

std::vector<std::vector<SeenPoint>> seenPoints(const FramePlan& plan) {
    std::vector<std::vector<SeenPoint>> rays(rayColumns * rayRows);
    parallelFor(rays.size(), [&](std::size_t i) {
        const auto column = static_cast<double>(i % rayColumns);
        const auto row = static_cast<double>(i / rayColumns);
        // Use 0.501 instead of 0.5: crossing() divides by the components of the direction, and with an odd number of
        // rays, 0.5 would make a component of the central rays 0.
        rays[i] = seenAlong(plan, {2 * (column + 0.501) / rayColumns - 1, 2 * (row + 0.501) / rayRows - 1});
    });
    std::erase_if(rays, [](const std::vector<SeenPoint>& ray) { return ray.empty(); });
    if (rays.empty()) rays.push_back(middles(plan));
    return rays;
}

}  // namespace defocus::engine
