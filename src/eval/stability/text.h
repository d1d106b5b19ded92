#pragma once
// Rows of the stability benchmark and of lens honesty as tables for people and as JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/stability/lens_honesty.h"
#include "eval/stability/stability.h"

namespace defocus {

// With a heading where `before` (null: none) measured something else, or against something else.
std::string stabilityLine(const StabilityRow& row, const StabilityRow* before);
std::string honestyHeader();
std::string honestyLine(const HonestyRow& row);
// A line for each method with its settings: how far it is off at most, and how many of its rows follow the lens.
std::string honestySummary(std::span<const HonestyRow> rows);
std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject);

}  // namespace defocus
