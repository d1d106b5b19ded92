// Source: Garcia 2018, Circular Separable Convolution Depth of Field (transparency).

#include "render/post_process/transparency_buckets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "plan/visible/visibility.h"

namespace defocus::engine {

namespace {

constexpr double minStep = 1;  // min difference between the blur diameters of two buckets, px
// Margin in px around a bucket's blurred objects. The blur reads reduced images, whose pixels cover several image
// pixels, so it reaches farther than its radius.
constexpr double margin = 24;

// Returns the middle of a range of signed blur diameters in px, clamped to the image's width.
double middleOf(const CocRange& coc, double width) {
    return 0.5 * (std::clamp(coc.nearest, -width, width) + std::clamp(coc.farthest, -width, width));
}

bool overlapInTheImage(const ObjectPlan& a, const ObjectPlan& b, const FramePlan& plan) {
    if (std::min(a.nearestDepth, b.nearestDepth) <= plan.view.nearPlane) return true;
    const CocBox boxA = cocBoxOf(a.viewBox, a.own, plan);
    const CocBox boxB = cocBoxOf(b.viewBox, b.own, plan);
    return glm::all(glm::lessThan(boxA.ndcMin, boxB.ndcMax)) && glm::all(glm::lessThan(boxB.ndcMin, boxA.ndcMax));
}

// Returns the indices of the blended objects that get a bucket, front to back. Transmitting objects get none. Nor does
// an object behind such an excluded object, if the two may overlap in the image.
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

std::vector<TransparencyBucket> transparencyBuckets(const FramePlan& plan, std::uint32_t max) {
    if (max == 0 || !plan.usesBlending || !plan.usesLens) return {};
    const std::vector<std::size_t> blended = blendedObjects(plan);
    if (blended.empty()) return {};

    struct Step {
        double height = 0;       // difference in blur diameter (px) of two neighbours in depth order
        std::size_t behind = 0;  // index into `blended` of the farther neighbour
    };
    std::vector<Step> steps;
    const auto blurOf = [&](std::size_t i) { return middleOf(plan.objects[blended[i]].coc, plan.view.width); };
    for (std::size_t i = 1; i < blended.size(); ++i)
        if (const double height = std::abs(blurOf(i) - blurOf(i - 1)); height >= minStep) steps.push_back({height, i});
    std::ranges::stable_sort(steps, std::ranges::greater{}, &Step::height);
    steps.resize(std::min<std::size_t>(steps.size(), max - 1));
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

TexelRectangle reachOf(const TransparencyBucket& bucket, const FramePlan& plan) {
    const glm::dvec2 size(plan.view.width, plan.view.height);
    glm::dvec2 min(std::numeric_limits<double>::infinity());
    glm::dvec2 max = -min;
    double diameter = 0;
    for (const std::size_t index : bucket) {
        const ObjectPlan& object = plan.objects[index];
        diameter = std::max(diameter, object.coc.largest);
        const bool everywhere = object.nearestDepth <= plan.view.nearPlane;
        const CocBox box = everywhere ? CocBox{} : cocBoxOf(object.viewBox, object.own, plan);
        min = everywhere ? glm::dvec2(0) : glm::min(min, (box.ndcMin + 1.0) * 0.5 * size);
        max = everywhere ? size : glm::max(max, (box.ndcMax + 1.0) * 0.5 * size);
    }
    // For surfaces in front of the focus plane, a method may gather from a disk as large as the largest foreground blur
    // of all objects.
    for (const ObjectPlan& object : plan.objects) diameter = std::max(diameter, -object.coc.nearest);
    const double reach = margin + 0.5 * std::min(diameter, std::max(size.x, size.y));
    min = glm::clamp(glm::floor(min - reach), glm::dvec2(0), size);
    max = glm::clamp(glm::ceil(max + reach), glm::dvec2(0), size);
    const glm::ivec2 extent(glm::max(max - min, glm::dvec2(0)));
    return {static_cast<int>(min.x), static_cast<int>(min.y), extent.x, extent.y};
}

}  // namespace defocus::engine
