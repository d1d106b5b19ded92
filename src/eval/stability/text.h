#pragma once
// Writes the rows of the stability benchmark and of lens honesty as tables for people and as JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/stability/lens_honesty.h"
#include "eval/stability/stability.h"

namespace defocus::engine {

// Returns one line, with a heading above it if `before` measured something else or against another truth. `before` is
// null for the first row.
std::string stabilityLine(const StabilityRow& row, const StabilityRow* before);
std::string honestyHeader();
std::string honestyLine(const HonestyRow& row);
// Returns a line for each method with its settings: its largest error, and how many of its rows follow the lens.
std::string honestySummary(std::span<const HonestyRow> rows);
std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject);

}  // namespace defocus::engine
