#include "render/sampling/automatic_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "plan/render_settings.h"

namespace defocus::engine {

namespace {

// Max distance in px between a blurred point's images in neighbouring lens samples, if each sample is drawn at four
// subpixel positions.
constexpr double gapOfPositions = 1.25;
// From this number of triangles per pixel and sample on, it is faster to draw a quarter as many samples at four
// subpixel positions each.
constexpr double payingTriangles = 0.1;
// Max side in px of images that are drawn at four subpixel positions per sample. Their layers are twice as wide and
// high as the image.
constexpr int maxDoubledSide = 4096;
constexpr double maxDoubledPixels = 4 << 20;
constexpr std::uint32_t minSpread = 64;  // min samples for smooth penumbrae and motion blur

// Returns the number of samples, rounded up to a power of two or, above 64, to complete blocks of 64.
std::uint32_t roundedUp(std::uint32_t samples) {
    return samples <= blockSamples ? std::bit_ceil(samples)
                                   : (samples + blockSamples - 1) / blockSamples * blockSamples;
}

// Limits on the automatically chosen number of samples.
struct SampleLimits {
    std::uint32_t min;  // min number of samples
    double gap;         // max distance in px between a blurred point's images in neighbouring samples
};

struct QualityLimits {
    double flip;             // target error, as FLIP
    SampleLimits first;      // limits on the initial number of samples, if samples can be added after an estimate
    SampleLimits unchecked;  // limits on the number of samples, if the error is not estimated during drawing
};

QualityLimits limitsOf(Quality quality) {
    switch (quality) {
        case Quality::draft:
            return {0.03, {16, 8}, {16, 3.5}};
        case Quality::good:
            return {0.01, {16, 4.5}, {32, 2}};
        case Quality::fine:
            return {0.005, {32, 3}, {64, 1.4}};
    }
    return {};
}

// Returns a number of samples within `limits` for a point that is blurred over `blur` px.
std::uint32_t samplesWithin(const SampleLimits& limits, double blur) {
    const double filling = std::numbers::pi / 4 * blur * blur / (limits.gap * limits.gap);
    if (!(filling > limits.min)) return limits.min;
    const auto samples = static_cast<std::uint32_t>(std::ceil(std::min(filling, double{maxAutomaticSamples})));
    return roundedUp(samples);
}

std::uint32_t samplesWithin(SampleLimits limits, const FramePlan& plan) {
    const bool spreads = !plan.shadows.maps.empty() || !plan.moments.empty();
    if (spreads) limits.min = std::max(limits.min, minSpread);
    return samplesWithin(limits, plan.view.lens.dofEnabled ? largestBoundedBlur(plan) : 0);
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
    return samplesWithin(limitsOf(quality).first, plan);
}

std::uint32_t firstSamples(double blur, Quality quality) {
    return samplesWithin(limitsOf(quality).first, blur);
}

bool fourPositionsSuffice(const FramePlan& plan, double samples) {
    const bool onlyLens = plan.usesLens && plan.shadows.maps.empty() && plan.moments.empty() &&
                          !plan.usesTransmission && plan.coc.chromatic == 0 &&
                          std::ranges::none_of(plan.blendOrder, &BlendRun::stochastic);
    const double pixels = static_cast<double>(plan.view.width) * plan.view.height;
    const bool fits = std::max(plan.view.width, plan.view.height) <= maxDoubledSide && pixels <= maxDoubledPixels;
    const double triangles = static_cast<double>(plan.trianglesDrawn) / static_cast<double>(plan.samples.size());
    // Distance in px between a blurred point's images in neighbouring samples, if only `samples` / 4 samples are drawn,
    // with four subpixel positions each.
    const double gap = plan.largestBlur * std::sqrt(std::numbers::pi / samples);
    return onlyLens && fits && triangles >= payingTriangles * pixels && gap <= gapOfPositions;
}

RenderSettings withSamples(RenderSettings settings, const FramePlan& plan, double samples, bool choosesPositions) {
    if (choosesPositions && fourPositionsSuffice(plan, samples)) settings.positions = 4;
    settings.sampleCount = roundedUp(static_cast<std::uint32_t>(std::ceil(samples / settings.positions)));
    return settings;
}

std::uint32_t samplesForBlur(const FramePlan& plan, Quality quality) {
    return samplesWithin(limitsOf(quality).unchecked, plan);
}

}  // namespace defocus::engine
