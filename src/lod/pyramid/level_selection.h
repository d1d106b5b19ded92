#pragma once
// Selects the level of detail of an object. The object's blur and its projected size give a real-valued level λ, which
// is a continuous function of the camera (Jeong, Kim and Lee 2011). The N lens samples are divided between the two
// integer levels next to λ.

#include <cstdint>
#include <optional>

#include "defocus/settings.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Return the names of modes and metrics on the command line.
const char* lodModeName(LodMode mode);
const char* lodMetricName(LodMetric metric);

// Thresholds set by the user. Unset thresholds have defaults that depend on the sample count, so that long renders
// converge to full detail. The meaning of the thresholds `blur`, `size` and `light` depends on the metric. For a circle
// of confusion (CoC) of c px:
//   metric size: the target edge length of a level is max(`blur` · c, `size`) px.
//   metric error: the target distance between the surfaces of a level and of the mesh is max(`blur` · c, `size`) px.
//   metric score: the target edge length is `blur` · c px.
//   metric proportional: `blur` is the level of an object whose CoC is as large as its projected bounding box.
//   metric measured: a level whose edges are `edge` px long may have a relative error of at most `light` / `edge`.
//     The relative error is an error in radiance, divided by the standard deviation of the radiance within a blur disk.
//     The relative error has no unit, so `light` is a length in px.
struct GivenThresholds {
    std::optional<double> blur = {};   // target divided by the CoC, ≥ 0; for `proportional`, a level number
    std::optional<double> size = {};   // lower bound on the target, px, ≥ 0
    std::optional<double> light = {};  // limit on (relative error) × (edge length in px), ≥ 0; only for `measured`
};

// Resolves LodMetric::automatic to a concrete metric; returns any other metric unchanged.
LodMetric chosenMetric(LodMetric metric, const GivenThresholds& given);

struct LodThresholds {
    double blur = 0;  // target (edge length or error) divided by the CoC; for `proportional`, a level number
    double size = 0;  // lower bound on the target, px
    // Upper limit on a level's relative error, multiplied by the level's edge length in px. The relative error is an
    // error in radiance, divided by the standard deviation of the radiance within a blur disk; see measuredLimit. 0 for
    // all metrics except LodMetric::measured.
    double light = 0;
};

// Returns the given thresholds, completed from defaultThresholds. Thresholds that the metric ignores are 0.
LodThresholds chosenThresholds(const GivenThresholds& given, LodMetric metric, std::uint32_t sampleCount);

// Returns the error of N lens samples relative to the error of one sample: N^(−0.65). All sample sequences except the
// random one converge at this rate on rendered scenes (bench/results/llvmpipe-sequences.txt).
double expectedSampleError(std::uint32_t sampleCount);

// Level of an object whose circle of confusion is as large as its projected bounding box, for the metric
// `proportional`. Jeong, Kim and Lee 2011 state no value. Of the values 10 · 2ⁿ, this is the largest whose levels raise
// the FLIP error of the built-in school of fish at 32 samples by at most 2 % (docs/reference.md).
inline constexpr double proportionalLevels = 10;

// Returns the default thresholds (LodThresholds) of a metric for N = `sampleCount` lens samples.
//
// Metrics `size`, `error` and `score`: the thresholds `blur` and `size` are (64/N)^(2/3) times their values at N = 64.
// The threshold `blur` is at most twice its value at N = 64; this limit applies for N ≤ 22. The threshold `size` never
// exceeds its value at N = 64, because few samples do not blur objects in focus; it is 0 for the metric `score`. The
// thresholds at N = 64 select the coarsest levels with a PSNR of at least 42 dB against full detail, for the built-in
// school of fish at 1024 × 768. The levels' error grows as threshold^1.3; the error of Sobol points falls as N^(−0.65).
// Up to N = 32, the levels' error is therefore 0.9 to 1.6 times the sampling error. In this range, finer levels with
// fewer samples gain nothing. The ratio is 2.4 at N = 64 and decreases beyond; both errors vanish as N grows. These
// ratios were measured on the school of fish at 512 × 384 (bench/results/llvmpipe-thresholds.txt).
//
// Metric `proportional`: `blur` is proportionalLevels for every N, because the rule of Jeong, Kim and Lee 2011 does not
// depend on the number of samples.
//
// Metric `measured`: `light`, the limit on (relative error) × (edge length), is 6.7 · expectedSampleError(N)². The
// error of one sample at a random lens position is the standard deviation of the radiance within a blur disk. The error
// of N samples is expectedSampleError(N) times that deviation. The error of the selected levels is much smaller than
// the sampling error, so that it hardly raises the RMS of both together. A larger error would be visible, because it
// appears as large soft spots on objects. FLIP, like the eye, weighs such spots more than the outlines and fine ghosts
// caused by sampling.
LodThresholds defaultThresholds(LodMetric metric, std::uint32_t sampleCount);

// Returns the max relative error of a level for LodMetric::measured: the max error in radiance, divided by the standard
// deviation of the radiance within a blur disk. `light` is the threshold LodThresholds::light, and `edge` the level's
// mean edge length in px (> 0). The limit is light / edge, but at most 0.3 times expectedSampleError(N), where N is the
// sample count whose default threshold is `light`.
//
// The factor 1 / edge saves the most triangles for a given sum of squared errors over the image. Halving a level's
// triangles doubles its error, so the optimum is a squared error proportional to the triangles per pixel. Objects with
// small triangles are therefore simplified first.
double measuredLimit(double light, double edge);

struct LevelQuery {
    // Pixels per object unit: s · W / (2 tan(θx/2) · z), with the object's largest scale s, the image width W and the
    // horizontal field of view θx. z is the nearest depth of the object; for LodMetric::score, it is the depth of the
    // bounding box's centre.
    double pixelsPerUnit = 0;
    double boxSize = 0;  // longer side of the projected bounding box, px, ≥ 0; used only by LodMetric::proportional
    double coc = 0;      // lower bound of the CoC diameter over the object, px, ≥ 0
};

// Selects the real-valued level λ in [0, levels − 1] for all metrics except LodMetric::measured (see blurred_error.h).
// For the thresholds B (LodThresholds::blur) and S (LodThresholds::size) and a CoC diameter of c px, the target in px
// is τ = max(B·c, S). λ is continuous in the query.
//   metric size: λ is the level whose mean edge projects to τ. The logarithms of the mean edges are interpolated.
//   metric score: like `size`, but with τ = B·c. λ is thus the level whose mean edge is B·s times that of level 0.
//     s = c/d is the score of Tzeng et al. 2012; d is the mean edge of level 0 at the depth of the box's centre.
//   metric proportional: λ = B·c/p for a projected bounding box of p px; 0 if c = 0; the coarsest level if p = 0 < c.
//     Jeong, Kim and Lee 2011 state that λ is proportional to the blur and to 1/p, without a constant.
//   metric error: λ = l + (τ − e[l]) / (e[l+1] − e[l]), where e are the stored errors projected to px, and
//     e[l] ≤ τ ≤ e[l+1].
// Returns 0 if pixelsPerUnit is negative, infinite or NaN. Returns the coarsest level if pixelsPerUnit is 0, because
// the object is then a point.
double levelOfDetail(const Pyramid& pyramid, const LevelQuery& query, LodMetric metric,
                     const LodThresholds& thresholds);

// Division of N lens samples between two levels of detail. Samples [0, coarseCount) draw level `level` + 1, and samples
// [coarseCount, N) draw level `level`. Let λ be the real-valued level and f = λ − ⌊λ⌋. The mode (LodMode) sets
// coarseCount:
//   fractional: coarseCount = round(f·N). As λ changes, one complete sample after another switches its level.
//   continuous: f·N = n + g with the integer n = coarseCount and 0 ≤ g < 1.
//     In sample n, a fraction g of the pixels draws the coarser level (screen door).
//     As λ changes, the pixels of one sample switch one after another, evenly spread.
// In the continuous mode, each pixel of each sample still draws exactly one level, so that objects have no holes. Where
// the outlines of the two levels differ, coverage changes by at most 1/N of a pixel.
struct SampleSplit {
    std::uint32_t level = 0;
    std::uint32_t coarseCount = 0;
    double boundaryShare = 0;  // fraction g of the pixels in which sample `coarseCount` draws the coarser level
};

SampleSplit splitSamples(double lambda, std::uint32_t sampleCount, LodMode mode);

}  // namespace defocus::engine
