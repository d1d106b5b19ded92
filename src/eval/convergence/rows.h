#pragma once
// Summarises the frames of each case as one row: medians with their spread, and whether another row beats it. Also
// computes how far each setting of the levels stays from full detail, however many lens samples it has.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/convergence.h"
#include "eval/spread.h"

namespace defocus::engine {

struct ConvergenceRow {
    std::string method;
    std::string form;  // see ConvergenceCase
    std::string setting;
    std::uint32_t asked = 0;    // requested lens samples; 0 if the method takes none
    std::uint32_t samples = 0;  // lens samples drawn
    int runs = 0;
    Spread milliseconds;              // wall-clock time of a frame
    Spread setupMilliseconds;         // time of the renderer's set-up; not part of `milliseconds`
    double pyramidMilliseconds = 0;   // time of building the pyramids; not part of `milliseconds`
    double gpuMilliseconds = 0;       // median
    ImageError error;                 // against the reference; the mean over the seeds
    std::optional<ImageError> bias;   // only with levels: against full detail at the same lens samples; the same mean
    std::vector<ImageError> ofSeeds;  // the error of each seed that was drawn
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;
    bool front = false;          // no other row of any method beats it: see paretoFront, with time and MSE
    bool frontOfMethod = false;  // the same among the rows of its method
    bool frontByFlip = false;    // the same as `front`, with FLIP instead of MSE
    // True if the error is smaller than the reference's own error; the value is then only an upper bound.
    bool mseBelowReference = false;
    bool flipBelowReference = false;
    std::string fault;  // says why the image isn't valid; such a row is on no front
};

// Returns the rows in the order in which their cases first appear. `remaining` is the reference's estimate of its own
// error, `seeds` as in ConvergenceOptions.
std::vector<ConvergenceRow> convergenceRows(std::span<const ConvergenceRun> runs, const Difference& remaining = {},
                                            int seeds = 1);

struct Trial {
    double cost = 0;
    double error = 0;
};

// Returns for each trial whether it is on the Pareto front. A trial is off the front if another one has a lower or
// equal cost and a lower or equal error, and one of them is lower. Equal trials are all on the front or all off it.
std::vector<bool> paretoFront(std::span<const Trial> trials);

// Error of one setting of the levels against full detail, with the thresholds of the largest measured number of
// samples. More lens samples would not reduce the error: both images have the same sampling noise, which cancels in
// their difference.
struct BiasFloor {
    std::string method;
    std::string setting;
    std::uint32_t samples = 0;  // number of lens samples of the measurement
    ImageError error;
};

// Returns one floor for each setting with levels.
std::vector<BiasFloor> biasFloors(std::span<const ConvergenceRow> rows);

}  // namespace defocus::engine
