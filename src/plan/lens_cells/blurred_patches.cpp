#include "plan/lens_cells/blurred_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "plan/motion/object_pose.h"

namespace defocus::engine {

namespace {

// Returns the min |CoC| in px that the object's surfaces can have at a depth and an image position.
double minCoc(const ObjectPlan& object, const FramePlan& plan, double depth, const glm::dvec2& ndc) {
    return smallestCoc(plan, {depth, depth, ndc, ndc, object.own});
}

double pixelsPerUnit(const ObjectPlan& object, const FramePlan& plan, double depth) {
    return largestScale(object.pose) * plan.view.width / (2 * plan.tanHalfHorizontal * depth);
}

}  // namespace

double smallestCoc(const FramePlan& plan, const CocBox& box) {
    CocRange range = circleOfConfusionRange(plan.coc, box, plan.view.width);
    if (!plan.settings.refocus) return range.smallest;
    for (const double focus : {plan.settings.refocus->nearest, plan.settings.refocus->farthest}) {
        const CocRange other = circleOfConfusionRange(refocused(plan.coc, focus), box, plan.view.width);
        range.nearest = std::min(range.nearest, other.nearest);
        range.farthest = std::max(range.farthest, other.farthest);
    }
    if (range.nearest <= 0 && range.farthest >= 0) return 0;
    return std::min(std::abs(range.nearest), std::abs(range.farthest));
}

double pixelsPerUnitAtCentre(const ObjectPlan& object, const FramePlan& plan) {
    return pixelsPerUnit(object, plan, -object.viewBox.centre().z);
}

double cocAtCentre(const ObjectPlan& object, const FramePlan& plan) {
    const glm::dvec3 centre = object.viewBox.centre();
    const glm::dvec2 ndc = glm::dvec2(centre) * glm::dvec2(1, plan.coc.aspect) / (-centre.z * plan.tanHalfHorizontal);
    return minCoc(object, plan, -centre.z, ndc);
}

std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan) {
    const double pixel = plan.settings.lodCause == LodCause::blur ? 0 : 1;
    const double blur = plan.settings.lodCause == LodCause::size ? 0 : 1;
    const auto sideAt = [&](double depth, double coc) {
        return std::sqrt(pixel + 0.75 * blur * coc * coc) / pixelsPerUnit(object, plan, depth);
    };
    std::array<double, patchDepths> sides;
    if (plan.settings.lodCoc == LodCoc::centre) {
        sides.fill(sideAt(-object.viewBox.centre().z, cocAtCentre(object, plan)));
        return sides;
    }
    for (std::size_t i = 0; i < patchDepths; ++i) {
        const double depth =
            glm::mix(object.nearestDepth, object.farthestDepth, (static_cast<double>(i) + 0.5) / patchDepths);
        const double coc = minCoc(object, plan, depth, glm::dvec2(0));
        sides[i] = sideAt(depth, std::clamp(coc, object.coc.smallest, object.coc.largest));
    }
    return sides;
}

}  // namespace defocus::engine
