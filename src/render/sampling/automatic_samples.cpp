#include "render/sampling/automatic_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "render/gpu_scene/frame_uniforms.h"

namespace defocus::engine {

namespace {

// Max distance in px between a blurred point's images in neighbouring samples with four pixel positions each.
constexpr double gapOfPositions = 1.25;
constexpr double payingTriangles = 0.1;  // min triangles per pixel and sample at which four pixel positions save time
// Max side in px of images with four pixel positions per sample, whose layers are twice as wide and high.
constexpr int maxDoubledSide = 4096;
constexpr double maxDoubledPixels = 4 << 20;
constexpr std::uint32_t minSpread = 64;  // min samples for smooth penumbrae and motion blur

struct QualityLimits {
    double flip;        // target error, as FLIP
    double firstGap;    // max distance in px between a blurred point's images in neighbouring samples
    double gap;         // like firstGap, for frames whose error is not estimated while they are drawn
    std::uint32_t min;  // min number of samples
};

QualityLimits limitsOf(Quality quality) {
    switch (quality) {
        case Quality::draft:
            return {0.03, 8, 3.5, 16};
        case Quality::good:
            return {0.01, 4.5, 2, 32};
        case Quality::fine:
            return {0.005, 3, 1.4, 64};
    }
    return {};
}

// Returns the number of samples, at least `min`, at which the images of a point blurred over `blur` px are at most
// `gap` px apart.
std::uint32_t samplesForGap(double blur, double gap, std::uint32_t min) {
    const double filling = std::numbers::pi / 4 * blur * blur / (gap * gap);
    if (!(filling > min)) return min;
    const double blocks = std::ceil(std::min(filling, double{maxAutomaticSamples}) / blockSamples);
    return static_cast<std::uint32_t>(blocks) * blockSamples;
}

std::uint32_t samplesForGap(const FramePlan& plan, const QualityLimits& limits, double gap) {
    const double blur = plan.view.lens.dofEnabled ? largestBoundedBlur(plan) : 0;
    const bool spreads = !plan.shadows.maps.empty() || !plan.moments.empty();
    return samplesForGap(blur, gap, spreads ? std::max(limits.min, minSpread) : limits.min);
}

}  // namespace

double flipOf(Quality quality) {
    return limitsOf(quality).flip;
}

double largestSampledBlur(const FramePlan& plan) {
    const double pixels = static_cast<double>(plan.view.width) * plan.view.height;
    return std::sqrt(4 / std::numbers::pi * maxAutomaticSamples * pixels);
}

bool blursBeyondSamples(const FramePlan& plan) {
    const double max = largestSampledBlur(plan);
    return std::ranges::any_of(plan.objects, [&](const ObjectPlan& object) {
        return std::isfinite(object.coc.largest) && object.coc.largest > max;
    });
}

double largestBoundedBlur(const FramePlan& plan) {
    const double max = largestSampledBlur(plan);
    double largest = 0;
    for (const ObjectPlan& object : plan.objects)
        if (object.nearestDepth > plan.view.nearPlane && object.coc.largest <= max)
            largest = std::max(largest, object.coc.largest);
    return largest;
}

std::uint32_t firstSamples(const FramePlan& plan, Quality quality) {
    const QualityLimits limits = limitsOf(quality);
    return samplesForGap(plan, limits, limits.firstGap);
}

std::uint32_t firstSamples(double blur, Quality quality) {
    const QualityLimits limits = limitsOf(quality);
    return samplesForGap(blur, limits.firstGap, limits.min);
}

bool fourPositionsSuffice(const FramePlan& plan, double samples) {
    const bool onlyLens = plan.usesLens && plan.shadows.maps.empty() && plan.moments.empty() &&
                          !plan.usesTransmission && plan.coc.chromatic == 0 &&
                          std::ranges::none_of(plan.blendOrder, &BlendRun::stochastic);
    const double pixels = static_cast<double>(plan.view.width) * plan.view.height;
    const bool fits = std::max(plan.view.width, plan.view.height) <= maxDoubledSide && pixels <= maxDoubledPixels;
    const double triangles = static_cast<double>(plan.trianglesDrawn) / static_cast<double>(plan.samples.size());
    // Distance in px between a blurred point's images in neighbouring samples, for a quarter of the samples.
    const double gap = plan.largestBlur * std::sqrt(std::numbers::pi / samples);
    return onlyLens && fits && triangles >= payingTriangles * pixels && gap <= gapOfPositions;
}

RenderSettings withSamples(RenderSettings settings, const FramePlan& plan, double samples, bool choosesPositions) {
    if (choosesPositions && fourPositionsSuffice(plan, samples)) settings.positions = 4;
    const auto count = static_cast<std::uint32_t>(std::ceil(samples / settings.positions));
    settings.sampleCount =
        count <= blockSamples ? std::bit_ceil(count) : (count + blockSamples - 1) / blockSamples * blockSamples;
    return settings;
}

std::uint32_t samplesForBlur(const FramePlan& plan, Quality quality) {
    const QualityLimits limits = limitsOf(quality);
    return samplesForGap(plan, limits, limits.gap);
}

}  // namespace defocus::engine
