#pragma once
// Frames of the popping benchmark summed up, as a table for people, as CSV and as JSON.

#include <span>
#include <string>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/popping/popping.h"

namespace defocus {

// One measure over the frames of a movement.
struct PopSummary {
    double worst = 0;
    int worstFrame = 0;
    double percentile99 = 0;  // interpolated linearly between frames
    double ofNearest = 0;     // the worst over that of LodMode::nearest; NaN where that is 0 or missing
};

struct PoppingRow {
    Movement movement = Movement::focusPull;
    std::uint32_t samples = 0;
    LodMode mode = LodMode::off;
    int frames = 0;  // changes, one fewer than views
    double speed = 0;
    PopSummary changeRmse, changeFlip, stepRmse, stepFlip;  // over the objects' pixels
    PopSummary changeRmseImage, changeFlipImage, stepRmseImage, stepFlipImage;
};

// A row for each movement, number of samples and mode, in the order in which their first frames come.
std::vector<PoppingRow> poppingRows(std::span<const PoppingFrame> frames);

std::string poppingHeader();                         // two lines
std::string poppingLine(const PoppingRow& row);      // one line
std::string sampleStepLine(const SampleStep& step);  // one line, complete by itself
// The largest pop of each mode as a fraction of the nearest level's, at the most samples.
std::string poppingSummary(std::span<const PoppingRow> rows);

std::string poppingCsv(std::span<const PoppingFrame> frames);  // a line a frame
// Of each movement, number of samples and mode the worst and the 99th percentile.
std::string poppingJson(std::span<const PoppingFrame> frames, std::span<const SampleStep> steps,
                        const BenchSubject& subject, const PoppingOptions& options);

}  // namespace defocus
