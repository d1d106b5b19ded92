#include "render/sampling/automatic_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/gpu_scene/frame_uniforms.h"

namespace defocus::engine {

namespace {

constexpr double gap = 2;  // px between the images of a blurred point in neighbouring samples
constexpr std::uint32_t movingSamples = 4 * blockSamples;
constexpr std::uint32_t shadowSamples = 64;  // min for smooth penumbrae and sky shadows

}  // namespace

double largestBoundedBlur(const FramePlan& plan) {
    double largest = 0;
    for (const ObjectPlan& object : plan.objects)
        if (object.nearestDepth > plan.view.nearPlane) largest = std::max(largest, object.coc.largest);
    return largest;
}

std::uint32_t samplesForBlur(const FramePlan& plan) {
    const double blur = plan.view.lens.dofEnabled ? largestBoundedBlur(plan) : 0;
    const double filling = std::numbers::pi / 4 * blur * blur / (gap * gap);
    const std::uint32_t still = plan.shadows.maps.empty() ? minAutomaticSamples : shadowSamples;
    const std::uint32_t min = plan.moments.empty() ? still : movingSamples;
    if (!(filling > min)) return min;
    const double blocks = std::ceil(std::min(filling, double{maxAutomaticSamples}) / blockSamples);
    return static_cast<std::uint32_t>(blocks) * blockSamples;
}

}  // namespace defocus::engine
