#pragma once
// Summarises the runs of each case as one row: medians, their spread, and whether the row is on a Pareto front. Also
// computes the error of each level-of-detail setting relative to full detail; more lens samples cannot reduce this
// error.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/convergence.h"
#include "eval/spread.h"

namespace defocus::engine {

struct ConvergenceRow {
    std::string method;
    std::string form;  // variant of the settings; see ConvergenceCase::form
    std::string setting;
    std::uint32_t asked = 0;    // requested lens samples; 0 if the method uses none
    std::uint32_t samples = 0;  // number of lens samples drawn
    int runs = 0;
    Spread milliseconds;              // wall-clock time of a frame
    Spread setupMilliseconds;         // set-up time of the renderer; not part of `milliseconds`
    double pyramidMilliseconds = 0;   // build time of the pyramids; not part of `milliseconds`
    double gpuMilliseconds = 0;       // median GPU time, from timer queries
    ImageError error;                 // image difference from the reference image, mean over the seeds
    std::optional<ImageError> bias;   // image difference from full detail, mean over the seeds; nullopt without levels
    std::vector<ImageError> ofSeeds;  // error of each measured seed's image
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;
    bool front = false;          // true: on the Pareto front of time and MSE (paretoFront) of all rows
    bool frontOfMethod = false;  // true: on the Pareto front of time and MSE of its method's rows
    bool frontByFlip = false;    // true: on the Pareto front of time and FLIP of all rows
    // True if the error is smaller than the reference's own error; the value of the error is then only an upper bound.
    bool mseBelowReference = false;
    bool flipBelowReference = false;
    std::string fault;  // why the image is invalid; empty if valid. Invalid rows are on no Pareto front
};

// Returns one row per case, in the order in which the cases first appear in `runs`. `remaining`: estimate of the error
// that the reference itself still has. `seeds`: ConvergenceOptions::seeds.
std::vector<ConvergenceRow> convergenceRows(std::span<const ConvergenceRun> runs, const Difference& remaining = {},
                                            int seeds = 1);

struct Trial {
    double cost = 0;
    double error = 0;
};

// Returns, for each trial, whether it is on the Pareto front. A trial is not on the front if another trial's cost and
// error are both at most as large and at least one of them is smaller. Of several equal trials, either all are on the
// front or none.
std::vector<bool> paretoFront(std::span<const Trial> trials);

// Error of a level-of-detail setting relative to full detail, with the levels chosen for the largest measured number of
// samples. More lens samples would not reduce this error: the image with levels and the image at full detail have the
// same sampling noise, which cancels in their difference.
struct BiasFloor {
    std::string method;
    std::string setting;
    std::uint32_t samples = 0;  // number of lens samples with which this error was measured
    ImageError error;
};

// Returns the error relative to full detail (BiasFloor) of each setting that draws levels.
std::vector<BiasFloor> biasFloors(std::span<const ConvergenceRow> rows);

}  // namespace defocus::engine
