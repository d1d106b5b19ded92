#pragma once
// Writes the rows of the speed-up benchmark as a text table, CSV and JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/speedup/speedup.h"

namespace defocus::engine {

std::string speedupHeader();                     // returns the table's header, two lines
std::string speedupLine(const SpeedupRow& row);  // returns the table's line for a row
std::string speedupCsv(std::span<const SpeedupRow> rows);

std::string speedupJson(std::span<const SpeedupRow> rows, const BenchSubject& subject);

}  // namespace defocus::engine
