#pragma once
// Chooses how coarse an object may be. Its blur and its projected size give a real-valued level λ, which is continuous
// in the camera (Jeong, Kim and Lee 2011). The N lens samples are split between the two levels around λ.

#include <cstdint>
#include <optional>

#include "defocus/settings.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// The names on the command line.
const char* lodModeName(LodMode mode);
const char* lodMetricName(LodMetric metric);

// The thresholds that a request gives. By size and by error the target is max(blur · c, size) px for a circle of
// confusion of c px. Measured levels err by at most light / edge, in standard deviations of the object's light within
// its blur, for edges of `edge` px. A threshold that isn't given follows the number of samples, so that long renders
// converge to full detail.
struct GivenThresholds {
    std::optional<double> blur = {};   // px a px of blur, ≥ 0
    std::optional<double> size = {};   // px, ≥ 0; not of LodMetric::score
    std::optional<double> light = {};  // px, ≥ 0; only of LodMetric::measured, which has neither of the others
};

// Returns the metric that `automatic` stands for, and any other metric as it is.
LodMetric chosenMetric(LodMetric metric, const GivenThresholds& given);

struct LodThresholds {
    double blur = 0;   // kBlur: target px per px of CoC
    double size = 0;   // kSize: least target in px
    double light = 0;  // the error of measured levels with edges of 1 px, in standard deviations of the light within
                       // the blur; see measuredLimit
};

// Returns the thresholds that are given, and the rest from defaultThresholds. Those that the metric doesn't have are 0.
LodThresholds chosenThresholds(const GivenThresholds& given, LodMetric metric, std::uint32_t sampleCount);

// Returns the error of N lens samples relative to that of one sample: N^(−0.65), which is how all sequences but the
// random one converge on rendered scenes (bench/results/llvmpipe-sequences.txt).
double expectedSampleError(std::uint32_t sampleCount);

// By size and by error, the defaults follow the number of samples N: they are (64/N)^(2/3) times the thresholds at N =
// 64. `blur` is at most twice as large as there (N ≤ 22). `size` is never larger than there, because few samples don't
// blur what is in focus. At N = 64 the levels are as coarse as 42 dB from full detail allow on the built-in school at
// 1024 × 768. The levels' error grows as threshold^1.3, and that of Sobol points falls as N^(−0.65). So the levels'
// error is 0.9 to 1.6 times the sampling error up to N = 32, where trading samples for finer levels gains nothing. It
// is 2.4 times the sampling error at 64 and less and less beyond, and both vanish as N grows (school of fish, 512 ×
// 384: bench/results/llvmpipe-thresholds.txt).
//
// Measured levels: `light` is 6.7 times the square of expectedSampleError(N). One sample, anywhere on the lens, is off
// by the standard deviation of the light within the blur, and N samples by expectedSampleError(N) times that deviation.
// So the levels' error vanishes beside that of the samples. It hardly raises the root mean square of both together. But
// a level is wrong in large soft spots all over an object, while samples are wrong at outlines and in fine ghosts, and
// FLIP, like the eye, minds the spots more.
LodThresholds defaultThresholds(LodMetric metric, std::uint32_t sampleCount);

// Returns by how much a measured level may be off whose edges are `edge` px long (> 0), in standard deviations of the
// light within the blur: by light / edge, and at most by 0.3 times the expected error of as many samples as have
// `light` by default. Of the levels whose squared errors have a given sum over the image, those with a squared error
// proportional to their triangles a pixel are drawn from the fewest triangles, as half of these double the error: the
// error goes with 1/edge. So small triangles give way first, and large ones, which save nothing, hardly do.
double measuredLimit(double light, double edge);

struct LevelQuery {
    // Projected px per object unit: largestScale · W / (2 tan(θx/2) · z), z the nearest depth, or of scores the depth
    // of the box's centre.
    double pixelsPerUnit = 0;
    double coc = 0;  // CoC diameter the object may rely on, px, ≥ 0
};

// Chooses λ in [0, levels − 1] by size, by halving or by error, with τ = max(blur·c, size); for measured levels see
// blurred_error.h. λ is continuous in the query.
//   size:  λ is where the stored mean edges, interpolated in their logarithm, project to τ.
//   halving: λ = 2·log2(τ/d), d the mean edge of level 0 as it projects: edges grow by √2 where triangles are halved.
//   score: the same as size with blur·c alone for τ. With s = c/d, d the mean edge of level 0 at the box's centre, λ is
//     where the mean edges have grown by blur·s (Tzeng et al. 2012, whose score s is).
//   error: λ = l + (τ − e[l]) / (e[l+1] − e[l]) between the stored errors projected to px.
// λ is 0 if pixelsPerUnit is negative, infinite or NaN. If it is 0 (the object is a point), λ is the coarsest level.
double levelOfDetail(const Pyramid& pyramid, const LevelQuery& query, LodMetric metric,
                     const LodThresholds& thresholds);

// Samples [0, coarseCount) draw level `level` + 1, samples [coarseCount, N) level `level`; f = λ − ⌊λ⌋.
//   fractional: coarseCount = round(f·N). As λ moves, a whole sample at a time changes its level.
//   continuous: f·N = n + g with n = coarseCount whole and 0 ≤ g < 1. Of sample n, the share g of the pixels draws the
//   coarser level (a screen door): as λ moves, the pixels of one sample change one after the other, evenly spread.
//   Each pixel of each sample still draws exactly one level: it is the pixel of the split with n coarse samples or that
//   with n + 1. So no object has holes, and where the outlines of its levels differ it gains or loses, by the screen
//   door, at most 1/N of a pixel's coverage.
struct SampleSplit {
    std::uint32_t level = 0;
    std::uint32_t coarseCount = 0;
    double boundaryShare = 0;  // g
};

SampleSplit splitSamples(double lambda, std::uint32_t sampleCount, LodMode mode);

}  // namespace defocus::engine
