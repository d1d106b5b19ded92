// Garcia 2018, Circular Separable Convolution Depth of Field (transparency).

#include "render/post_process/transparency_buckets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vector_relational.hpp>

#include "plan/visibility.h"

namespace defocus {

namespace {

constexpr double leastStep = 1;  // px of diameter

// Signed px; no more than a disk as wide as the image.
double middleOf(const CocRange& coc, double width) {
    return 0.5 * (std::clamp(coc.nearest, -width, width) + std::clamp(coc.farthest, -width, width));
}

bool overlapInTheImage(const ObjectPlan& a, const ObjectPlan& b, const FramePlan& plan) {
    if (std::min(a.nearestDepth, b.nearestDepth) <= plan.view.nearPlane) return true;
    const CocBox boxA = cocBoxOf(a.viewBox, a.own, plan);
    const CocBox boxB = cocBoxOf(b.viewBox, b.own, plan);
    return glm::all(glm::lessThan(boxA.ndcLeast, boxB.ndcMost)) && glm::all(glm::lessThan(boxB.ndcLeast, boxA.ndcMost));
}

// Front to back, without those that stay with what transmits: behind it, or behind one that stays.
std::vector<std::size_t> blendedObjects(const FramePlan& plan) {
    std::vector<std::size_t> blended;
    std::vector<std::size_t> staying;
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        const ObjectPlan& object = plan.objects[i];
        if (!object.blended && !object.transmits) continue;
        const bool stays = object.transmits || std::ranges::any_of(staying, [&](std::size_t nearer) {
                               return overlapInTheImage(plan.objects[nearer], object, plan);
                           });
        (stays ? staying : blended).push_back(i);
    }
    return blended;
}

}  // namespace

std::vector<TransparencyBucket> transparencyBuckets(const FramePlan& plan, std::uint32_t most) {
    if (most == 0 || !plan.usesBlending || !plan.usesLens) return {};
    const std::vector<std::size_t> blended = blendedObjects(plan);
    if (blended.empty()) return {};

    struct Step {
        double height = 0;       // px
        std::size_t behind = 0;  // into `blended`: the nearest object behind it
    };
    std::vector<Step> steps;
    const auto blurOf = [&](std::size_t i) { return middleOf(plan.objects[blended[i]].coc, plan.view.width); };
    for (std::size_t i = 1; i < blended.size(); ++i)
        if (const double height = std::abs(blurOf(i) - blurOf(i - 1)); height >= leastStep)
            steps.push_back({height, i});
    std::ranges::stable_sort(steps, std::ranges::greater{}, &Step::height);
    steps.resize(std::min<std::size_t>(steps.size(), most - 1));
    std::ranges::sort(steps, std::ranges::greater{}, &Step::behind);
    steps.push_back({0, 0});

    std::vector<TransparencyBucket> buckets;
    auto end = blended.end();
    for (const Step& step : steps) {
        const auto first = blended.begin() + static_cast<std::ptrdiff_t>(step.behind);
        buckets.emplace_back(first, end);
        end = first;
    }
    return buckets;
}

}  // namespace defocus
