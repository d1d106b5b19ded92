#pragma once
// Writes the rows of the scaling benchmark, with the exponents fitted to them, as a table for people, as CSV and as
// JSON.

#include <span>
#include <string>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/scaling/large_scenes.h"
#include "eval/scaling/scaling.h"

namespace defocus::engine {

std::string scalingHeader();                     // two lines
std::string scalingLine(const ScalingRow& row);  // one line

// Gives the exponent of the time along each axis, and what bounds the frame there, in sentences.
std::string scalingSummary(std::span<const ScalingRow> rows);

// Describes the largest parts of the rows of one axis and mode, in their order, such as "fill up to 300 k, vertex work
// and fill alike from 1 M".
std::string boundsAlong(std::span<const ScalingRow> rows);

struct ScalingLeftOut {
    ScalingPoint point;
    std::string reason;
};

std::string scalingLine(const ScalingLeftOut& leftOut);  // one line

std::string scalingCsv(std::span<const ScalingRow> rows);
std::string scalingJson(std::span<const ScalingRow> rows, std::span<const ScalingLeftOut> leftOut,
                        std::span<const LargeSceneRow> scenes, const BenchSubject& subject);

}  // namespace defocus::engine
