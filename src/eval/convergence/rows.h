#pragma once
// Frames made into rows, one a case: medians with their spread, which rows no other beats, and how far each setting of
// the levels stays from full detail however many lens samples there are.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/convergence/convergence.h"
#include "eval/spread.h"

namespace defocus {

struct ConvergenceRow {
    std::string method;
    std::string setting;
    std::uint32_t asked = 0;    // lens samples asked for; 0: the method takes none
    std::uint32_t samples = 0;  // drawn
    int runs = 0;
    Spread milliseconds;             // a frame, wall clock
    Spread setupMilliseconds;        // of the renderer, not in `milliseconds`
    double pyramidMilliseconds = 0;  // of the pyramids, not in `milliseconds`
    double gpuMilliseconds = 0;      // median
    ImageError error;                // from the reference
    std::optional<ImageError> bias;  // with levels: from full detail at the same lens samples
    std::uint64_t triangles = 0;
    std::uint64_t peakBytes = 0;
    bool front = false;          // no row of any method has both a lower or equal time and MSE, and one of them lower
    bool frontOfMethod = false;  // the same among the rows of its method
    bool frontByFlip = false;    // as `front`, by FLIP
    // The error is below the reference's own: it says no more than that.
    bool mseBelowReference = false;
    bool flipBelowReference = false;
    std::string fault;  // why the image is not what it claims to be: the row is on no front
};

// In the order in which the cases first appear. `remaining`: the reference's estimate of its own error.
std::vector<ConvergenceRow> convergenceRows(std::span<const ConvergenceRun> runs, const Difference& remaining = {});

struct Trial {
    double cost = 0;
    double error = 0;
};

// For each trial: is there no other with a lower or equal cost and error of which one is lower? (Pareto's front; equal
// trials are all on it or all off it.)
std::vector<bool> paretoFront(std::span<const Trial> trials);

// With this setting's thresholds of the largest number of samples measured, more lens samples bring the image no closer
// to full detail than this: sampling noise, the same in both images, cancels in their difference.
struct BiasFloor {
    std::string method;
    std::string setting;
    std::uint32_t samples = 0;  // where it was measured
    ImageError error;
};

// One for each setting with levels.
std::vector<BiasFloor> biasFloors(std::span<const ConvergenceRow> rows);

}  // namespace defocus
