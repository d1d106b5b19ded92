// Selects real-valued levels of detail from blur and projected size, as in Jeong, Kim and Lee 2011, Multi-Resolution
// Depth-of-Field Rendering.

#include "lod/pyramid/level_selection.h"

#include <algorithm>
#include <cmath>

#include "core/enum_name.h"

namespace defocus::engine {

namespace {

constexpr double referenceSamples = 64;
// Default thresholds at 64 samples: target / CoC, and min target in px. A target is an edge length or an error.
constexpr LodThresholds referenceSize{0.25, 3.3};     // for LodMetric::size and LodMetric::score
constexpr LodThresholds referenceError{0.018, 0.18};  // for LodMetric::error
constexpr double sampleExponent = 2.0 / 3.0;
constexpr double sampleErrorExponent = 0.65;
// Default LodThresholds::light for one lens sample: upper limit on a level's relative error, multiplied by the level's
// mean edge length in px.
constexpr double lightOfSampleError = 6.7;
// Max ratio of a level's error to the sampling error. At this ratio, levels raise the total RMS error by 4.4 %.
constexpr double sampleErrorShareMax = 0.3;
// Max factor by which the blur threshold is raised for fewer than 64 samples. The maximum limits the errors at
// outlines.
constexpr double largestFactor = 2;

// Returns whether the metric compares the levels' edge lengths, not their errors, with the target in px.
bool bySize(LodMetric metric) {
    return metric == LodMetric::size || metric == LodMetric::score;
}

double storedSize(const PyramidLevel& level, LodMetric metric) {
    return bySize(metric) ? level.meanEdge : level.error;
}

// Returns where `target` lies between the edge lengths or errors of two levels: 0 at the finer level, 1 at the coarser
// level. Edge lengths are interpolated logarithmically, because halving the number of triangles multiplies the edge
// length by a constant. Errors start at 0 and are interpolated linearly.
double between(double fine, double coarse, double target, LodMetric metric) {
    const double fraction = bySize(metric) && fine > 0 ? std::log(target / fine) / std::log(coarse / fine)
                                                       : (target - fine) / (coarse - fine);
    return std::clamp(fraction, 0.0, 1.0);
}

}  // namespace

const char* lodMetricName(LodMetric metric) {
    return enumName<LodMetric::score>(metric, {"automatic", "size", "error", "measured", "proportional", "score"});
}

const char* lodModeName(LodMode mode) {
    return enumName<LodMode::off>(mode, {"fractional", "continuous", "nearest", "off"});
}

double expectedSampleError(std::uint32_t sampleCount) {
    return std::pow(std::max(sampleCount, 1u), -sampleErrorExponent);
}

LodMetric chosenMetric(LodMetric metric, const GivenThresholds& given) {
    if (metric != LodMetric::automatic) return metric;
    return given.blur || given.size ? LodMetric::size : LodMetric::measured;
}

LodThresholds defaultThresholds(LodMetric metric, std::uint32_t sampleCount) {
    if (chosenMetric(metric, {}) == LodMetric::measured)
        return {.light = lightOfSampleError * std::pow(expectedSampleError(sampleCount), 2)};
    if (metric == LodMetric::proportional) return {.blur = proportionalLevels};
    const LodThresholds& reference = metric == LodMetric::error ? referenceError : referenceSize;
    const double factor = std::pow(referenceSamples / std::max(sampleCount, 1u), sampleExponent);
    const double blur = reference.blur * std::min(factor, largestFactor);
    if (metric == LodMetric::score) return {.blur = blur};
    return {blur, reference.size * std::min(factor, 1.0)};
}

double measuredLimit(double light, double edge) {
    const double sampleError = std::sqrt(light / lightOfSampleError);
    return std::min(sampleErrorShareMax * sampleError, light / edge);
}

LodThresholds chosenThresholds(const GivenThresholds& given, LodMetric metric, std::uint32_t sampleCount) {
    metric = chosenMetric(metric, given);
    const LodThresholds defaults = defaultThresholds(metric, sampleCount);
    if (metric == LodMetric::measured) return {.light = given.light.value_or(defaults.light)};
    if (metric == LodMetric::score || metric == LodMetric::proportional)
        return {.blur = given.blur.value_or(defaults.blur)};
    return {given.blur.value_or(defaults.blur), given.size.value_or(defaults.size)};
}

double levelOfDetail(const Pyramid& pyramid, const LevelQuery& query, LodMetric metric,
                     const LodThresholds& thresholds) {
    if (!std::isfinite(query.pixelsPerUnit) || query.pixelsPerUnit < 0 || pyramid.levels.empty()) return 0;
    const double coc = query.coc > 0 ? query.coc : 0;
    const double coarsest = static_cast<double>(pyramid.levels.size() - 1);
    if (metric == LodMetric::proportional)
        return coc > 0 && thresholds.blur > 0 ? std::min(thresholds.blur * coc / query.boxSize, coarsest) : 0;
    const double target = std::max(thresholds.blur > 0 ? thresholds.blur * coc : 0, thresholds.size);
    if (!(target > 0)) return 0;

    // Find the first level that is coarser than the target; the fractional level λ lies between this level and the
    // previous level.
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        const double coarse = storedSize(pyramid.levels[l], metric) * query.pixelsPerUnit;
        if (coarse <= target) continue;
        if (l == 0) return 0;
        const double fine = storedSize(pyramid.levels[l - 1], metric) * query.pixelsPerUnit;
        return static_cast<double>(l - 1) + between(fine, coarse, target, metric);
    }
    return coarsest;
}

SampleSplit splitSamples(double lambda, std::uint32_t sampleCount, LodMode mode) {
    if (mode == LodMode::off || !(lambda > 0)) return {};
    if (mode == LodMode::nearest) return {static_cast<std::uint32_t>(std::lround(lambda)), 0};
    const double integer = std::floor(lambda);
    const double coarse = (lambda - integer) * sampleCount;
    SampleSplit split{static_cast<std::uint32_t>(integer), 0};
    if (mode == LodMode::continuous) {
        split.coarseCount = static_cast<std::uint32_t>(coarse);
        split.boundaryShare = coarse - split.coarseCount;
    } else {
        split.coarseCount = static_cast<std::uint32_t>(std::lround(coarse));
    }
    return split;
}

}  // namespace defocus::engine
