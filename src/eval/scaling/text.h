#pragma once
// Rows of the scaling benchmark as a table for people, as CSV and as JSON, with the exponents fitted to them.

#include <span>
#include <string>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/scaling/scaling.h"

namespace defocus {

std::string scalingHeader();                     // two lines
std::string scalingLine(const ScalingRow& row);  // one line

// Exponents of the time against each axis, and what bounds the frame along it, in sentences.
std::string scalingSummary(std::span<const ScalingRow> rows);

// "fill up to 300 k, vertex work and fill alike from 1 M": the largest parts of the rows of one axis and mode, in their
// order.
std::string boundsAlong(std::span<const ScalingRow> rows);

struct ScalingLeftOut {
    ScalingPoint point;
    std::string reason;
};

std::string scalingLine(const ScalingLeftOut& leftOut);  // one line

std::string scalingCsv(std::span<const ScalingRow> rows);
std::string scalingJson(std::span<const ScalingRow> rows, std::span<const ScalingLeftOut> leftOut,
                        const BenchSubject& subject);

}  // namespace defocus
