#pragma once
// Summarises the frames of the popping benchmark as a text table, CSV and JSON.

#include <span>
#include <string>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/popping/popping.h"

namespace defocus::engine {

// Summary of one error measure over all frames of a movement.
struct PopSummary {
    double worst = 0;
    int worstFrame = 0;
    double percentile99 = 0;  // 99th percentile of the frames' errors, interpolated linearly
    double ofNearest = 0;     // `worst` divided by the `worst` of LodMode::nearest; NaN if the divisor is 0 or missing
};

struct PoppingRow {
    Movement movement = Movement::focusPull;
    std::uint32_t samples = 0;
    PoppingMode mode = PoppingMode::nearest;
    int frames = 0;  // number of pairs of consecutive frames
    double speed = 0;
    // Change and step as defined in popping.h: over the object pixels, and over the complete image.
    PopSummary changeRmse, changeFlip, stepRmse, stepFlip;
    PopSummary changeRmseImage, changeFlipImage, stepRmseImage, stepFlipImage;
};

// Returns a row for each combination of movement, number of samples and mode, ordered by first appearance.
std::vector<PoppingRow> poppingRows(std::span<const PoppingFrame> frames);

// Returns a line of text with the largest pop of each mode in the first frames of a movement.
std::string firstFramesLine(std::span<const PoppingFrame> frames);
std::string poppingHeader();                         // returns the table's header, two lines
std::string poppingLine(const PoppingRow& row);      // returns the table's line for a row
std::string sampleStepLine(const SampleStep& step);  // returns one line of text with labels
// Returns a sentence with the largest pop of each mode relative to LodMode::nearest, at the largest number of samples.
std::string poppingSummary(std::span<const PoppingRow> rows);

std::string poppingCsv(std::span<const PoppingFrame> frames);  // returns CSV with a line for each frame
// Returns JSON with the worst frame and the 99th percentile for each combination of movement, number of samples and
// mode.
std::string poppingJson(std::span<const PoppingFrame> frames, std::span<const SampleStep> steps,
                        const BenchSubject& subject, const PoppingOptions& options);

}  // namespace defocus::engine
