#pragma once
// Writes the rows of the stability benchmark, and of the test of blur against the lens equation (lens_honesty.h), as
// text tables and JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "stability/lens_honesty.h"
#include "stability/stability.h"

namespace defocus::engine {

// Returns a row of the stability benchmark as a line of text. A heading precedes the line if area, error or reference
// differ from those of the previous row `before`. `before` is null for the first row.
std::string stabilityLine(const StabilityRow& row, const StabilityRow* before);
std::string honestyHeader();
std::string honestyLine(const HonestyRow& row);
// Returns a line for each combination of method and settings: the largest error of the blur diameter, the range of the
// energy, and the number of rows whose blur agrees with the lens equation (HonestyRow::followsLens).
std::string honestySummary(std::span<const HonestyRow> rows);
std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject);

}  // namespace defocus::engine
