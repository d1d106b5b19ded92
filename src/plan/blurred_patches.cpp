#include "plan/blurred_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "plan/object_pose.h"

namespace defocus {

double cocAtCentre(const ObjectPlan& object, const FramePlan& plan) {
    const glm::dvec3 centre = object.viewBox.centre();
    const glm::dvec2 ndc = glm::dvec2(centre) * glm::dvec2(1, plan.coc.aspect) / (-centre.z * plan.tanHalfHorizontal);
    return std::abs(circleOfConfusion(plan.coc, -centre.z, plan.view.width, ndc, object.cocScale));
}

std::array<double, patchDepths> blurredPatches(const ObjectPlan& object, const FramePlan& plan) {
    const double scale = largestScale(object.pose);
    const double pixel = plan.settings.lodCause == LodCause::blur ? 0 : 1;
    const double blur = plan.settings.lodCause == LodCause::size ? 0 : 1;
    const auto sideAt = [&](double depth, double coc) {
        const double pixelsPerUnit = scale * plan.view.width / (2 * plan.tanHalfHorizontal * depth);
        return std::sqrt(pixel + 0.75 * blur * coc * coc) / pixelsPerUnit;
    };
    std::array<double, patchDepths> sides;
    if (plan.settings.lodCocAtCentre) {
        sides.fill(sideAt(-object.viewBox.centre().z, cocAtCentre(object, plan)));
        return sides;
    }
    for (std::size_t i = 0; i < patchDepths; ++i) {
        const double depth =
            glm::mix(object.nearestDepth, object.farthestDepth, (static_cast<double>(i) + 0.5) / patchDepths);
        const double coc =
            std::abs(circleOfConfusion(plan.coc, depth, plan.view.width, glm::dvec2(0), object.cocScale));
        sides[i] = sideAt(depth, std::clamp(coc, object.coc.smallest, object.coc.largest));
    }
    return sides;
}

}  // namespace defocus
