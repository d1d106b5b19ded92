#include "plan/visible/blend_part.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace defocus::engine {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

PosedPart posedPart(const glm::dmat4& viewFromObject, const std::vector<glm::vec3>& positions,
                    std::span<const std::uint32_t> indices, double side) {
    PosedPart part;
    const auto corner = [&](std::size_t i) {
        return glm::dvec3(viewFromObject * glm::dvec4(positions[indices[i]], 1));
    };
    part.nearest = unbounded;
    part.farthest = -unbounded;
    double largest = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const glm::dvec3& place = part.corners.emplace_back(corner(i));
        part.nearest = std::min(part.nearest, -place.z);
        part.farthest = std::max(part.farthest, -place.z);
        largest = std::max(largest, glm::length(place));
    }
    part.rounding = 1e-6 * largest;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = part.corners[i];
        const glm::dvec3 normal = side * glm::cross(part.corners[i + 1] - a, part.corners[i + 2] - a);
        const double length = glm::length(normal);
        if (length > 0) part.planes.push_back({normal / length, glm::dot(normal, a) / length});
    }
    return part;
}

// Returns whether no corner of the part lies behind `plane` (`sign` 1) or in front of `plane` (−1). Allows an error of
// `rounding` (m).
bool isOn(const Plane& plane, const PosedPart& part, double sign, double rounding) {
    return std::ranges::all_of(part.corners, [&](const glm::dvec3& corner) {
        return sign * (glm::dot(plane.normal, corner) - plane.distance) >= -rounding;
    });
}

// Returns whether the lens lies in front of `plane` (`sign` 1) or behind it (−1). The lens is a disk of radius
// `lensRadius` around the view-space origin, perpendicular to the z axis.
bool lensIsOn(const Plane& plane, double lensRadius, double sign) {
    return -sign * plane.distance - lensRadius * glm::length(glm::dvec2(plane.normal)) >= 0;
}

bool mayHide(const PosedPart& front, bool frontIsFlat, const PosedPart& behind, bool behindIsFlat, double lensRadius) {
    // `front` cannot hide `behind` if a plane separates `front` from both `behind` and the lens.
    const double rounding = std::max(front.rounding, behind.rounding);
    for (const Plane& plane : front.planes)
        for (const double sign : {1.0, -1.0})
            if ((sign > 0 || frontIsFlat) && lensIsOn(plane, lensRadius, sign) && isOn(plane, behind, sign, rounding))
                return false;
    for (const Plane& plane : behind.planes)
        for (const double sign : {1.0, -1.0})
            if ((sign < 0 || behindIsFlat) && lensIsOn(plane, lensRadius, sign) && isOn(plane, front, -sign, rounding))
                return false;
    return true;
}

}  // namespace

BlendPart blendPart(const ObjectPlan& object, const FramePlan& plan, const std::vector<glm::vec3>& positions,
                    std::span<const std::uint32_t> indices) {
    BlendPart part;
    part.flat = indices.size() == 3;
    part.low = glm::dvec2(unbounded);
    part.high = -part.low;
    const double pixels = 0.5 * plan.view.width / plan.tanHalfHorizontal;
    const double margin = 1 + 0.5 * object.coc.largest;
    const double side = object.mirrored ? -1 : 1;
    const auto add = [&](const ObjectPose& pose) {
        const PosedPart& posed =
            part.poses.emplace_back(posedPart(pose.viewFromJoint.front(), positions, indices, side));
        for (const glm::dvec3& corner : posed.corners) {
            const glm::dvec2 place = glm::dvec2(corner) * (pixels / -corner.z);
            const bool seen = posed.nearest > plan.view.nearPlane && std::isfinite(margin);
            part.low = seen ? glm::min(part.low, place - margin) : glm::dvec2(-unbounded);
            part.high = seen ? glm::max(part.high, place + margin) : glm::dvec2(unbounded);
        }
    };
    if (object.motion.empty()) add(object.pose);
    for (const ObjectPose& pose : object.motion) add(pose);
    return part;
}

bool overlap(const BlendPart& a, const BlendPart& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

bool mayHide(const BlendPart& front, const BlendPart& behind, const FramePlan& plan) {
    const std::size_t count = std::max(front.poses.size(), behind.poses.size());
    for (std::size_t i = 0; i < count; ++i) {
        const PosedPart& p = front.poses[std::min(i, front.poses.size() - 1)];
        const PosedPart& q = behind.poses[std::min(i, behind.poses.size() - 1)];
        if (p.nearest + p.rounding >= q.farthest) continue;
        // Planes can separate the parts only if lens samples map planes to planes, as with a thin lens. With other
        // lenses, only the depths are compared.
        if (plan.usesCocControls || mayHide(p, front.flat, q, behind.flat, 0.5 * plan.apertureDiameter)) return true;
    }
    return false;
}

bool showsOnlyBacks(const BlendPart& part, const FramePlan& plan) {
    if (plan.usesCocControls) return false;
    return std::ranges::all_of(part.poses, [&](const PosedPart& posed) {
        return std::ranges::all_of(
            posed.planes, [&](const Plane& plane) { return lensIsOn(plane, 0.5 * plan.apertureDiameter, -1); });
    });
}

}  // namespace defocus::engine
