#include "render/occlusion/lens_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/gpu_scene/layer_window.h"

namespace defocus::engine {

namespace {

constexpr double snapping = 0.25;           // max rounding of vertex positions by a rasterizer, px
constexpr double transformation = 0x1p-20;  // relative single-precision error of a transformed position
constexpr double interpolation = 0x1p-14;   // relative error of depths that are interpolated in a triangle

}  // namespace

bool seesBoxes(const FramePlan& plan) {
    return plan.moments.empty() && plan.middleFromView.empty() && !plan.usesOwnBlur && plan.coc.thinLens() &&
           plan.coc.chromatic == 0;
}

bool seesBoxes(const ObjectPlan& object) {
    return object.motion.empty() && !object.skinned && !object.deformed && object.own.none() &&
           object.refinement == Refinement::none;
}

// Uses the formula of throughLens in shaders/include/lens.glsl. The clip position is (x, y) in the pinhole view, plus
// C·(u, k·v), plus w·jitter. (u, v) is the lens point, k the aspect ratio of the image, w the depth, and C = a + b·w
// the circle of confusion with the coefficients a = coc.a and b = coc.front. jitter is the subpixel offset of the
// sample.
LensSight::LensSight(const FramePlan& plan, const ObjectPlan& object, std::uint32_t sample)
    : nearPlane_(plan.view.nearPlane) {
    const LensSample& lens = plan.samples[sample];
    const double aspect = plan.coc.aspect;
    const glm::dvec2 point(lens.lens.x, aspect * lens.lens.y);
    const glm::dvec2 jitter = -2.0 * glm::dvec2(lens.pixel) / glm::dvec2(plan.view.width, plan.view.height);
    glm::dmat3 clipFromView(0);
    clipFromView[0][0] = 1 / plan.tanHalfHorizontal;
    clipFromView[1][1] = aspect / plan.tanHalfHorizontal;
    clipFromView[2] = -glm::dvec3(plan.coc.front * point + jitter, 1);
    const glm::dvec3 origin(object.viewFromObject[3]);
    linear_ = clipFromView * glm::dmat3(object.viewFromObject);
    offset_ = clipFromView * origin + glm::dvec3(plan.coc.a * point, 0);
    for (glm::length_t i = 0; i < 3; ++i) sizes_[i] = glm::abs(linear_[i]);
    const LayerWindow window = layerWindow(plan);
    scale_ = 0.5 * glm::dvec2(window.imageWidth, window.imageHeight);
    middle_ = scale_ - glm::dvec2(window.imageLeft, window.imageBottom);
    layer_ = {window.layerWidth, window.layerHeight};
    const Bounds& box = object.viewBox;
    lost_ =
        transformation * (glm::length(glm::max(glm::abs(box.minimum), glm::abs(box.maximum))) + glm::length(origin));
}

std::optional<SeenBox> LensSight::of(const glm::vec3& centre, const glm::vec3& reach) const {
    const glm::dvec3 middle = linear_ * glm::dvec3(centre) + offset_;
    const glm::dvec3 half = sizes_ * glm::dvec3(reach);
    const double nearest = middle.z - half.z - lost_;
    const double farthest = middle.z + half.z + lost_;
    if (!(nearest > nearPlane_)) return {};
    const auto bounds = [&](glm::length_t axis, int& from, int& to) {
        const double low = middle[axis] - half[axis];
        const double high = middle[axis] + half[axis];
        const double margin = snapping + scale_[axis] * lost_ / nearest;
        const double min = middle_[axis] + scale_[axis] * low / (low < 0 ? nearest : farthest) - margin;
        const double max = middle_[axis] + scale_[axis] * high / (high < 0 ? farthest : nearest) + margin;
        const auto size = static_cast<double>(layer_[axis]);
        from = static_cast<int>(std::floor(std::clamp(min, 0.0, size)));
        to = static_cast<int>(std::ceil(std::clamp(max, 0.0, size)));
    };
    SeenBox seen;
    bounds(0, seen.left, seen.right);
    bounds(1, seen.bottom, seen.top);
    seen.depth = static_cast<float>(nearPlane_ / nearest * (1 + interpolation));
    return seen;
}

}  // namespace defocus::engine
