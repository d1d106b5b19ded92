#pragma once
// Writes the rows of the speed-up benchmark as a text table, CSV and JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/speedup/speedup.h"

namespace defocus::engine {

std::string speedupHeader();                     // returns the two header lines of the text table
std::string speedupLine(const SpeedupRow& row);  // returns one row of the text table, as a line
std::string speedupCsv(std::span<const SpeedupRow> rows);

std::string speedupJson(std::span<const SpeedupRow> rows, const BenchSubject& subject);

}  // namespace defocus::engine
