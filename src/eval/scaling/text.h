#pragma once
// Writes the rows of the scaling benchmark, and the exponents fitted to them, as a text table, CSV and JSON.

#include <span>
#include <string>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/scaling/large_scenes.h"
#include "eval/scaling/scaling.h"

namespace defocus::engine {

std::string scalingHeader();                     // returns the table's header, two lines
std::string scalingLine(const ScalingRow& row);  // returns the table's line for a row

// Returns a line for each axis and mode with the fitted exponents of time and memory, and with the parts of the work
// (ScalingPart) that limit the frame time.
std::string scalingSummary(std::span<const ScalingRow> rows);

// Describes, for each range of values on an axis, which parts of the work (ScalingPart) take most of the frame time.
// All `rows` have the same axis and level mode. Example for ScalingAxis::triangles: "fill up to 300 k, vertex work and
// fill alike from 1 M".
std::string boundsAlong(std::span<const ScalingRow> rows);

struct ScalingLeftOut {
    ScalingPoint point;
    std::string reason;
};

// Returns the line for an axis value that was not measured, with the reason.
std::string scalingLine(const ScalingLeftOut& leftOut);

std::string scalingCsv(std::span<const ScalingRow> rows);
std::string scalingJson(std::span<const ScalingRow> rows, std::span<const ScalingLeftOut> leftOut,
                        std::span<const LargeSceneRow> scenes, const BenchSubject& subject);

}  // namespace defocus::engine
