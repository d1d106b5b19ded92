#pragma once
// Rows of the stability benchmark and of lens honesty as tables for people and as JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/lens_honesty.h"
#include "eval/stability.h"

namespace defocus {

std::string stabilityHeader();
std::string stabilityLine(const StabilityRow& row);
std::string honestyHeader();
std::string honestyLine(const HonestyRow& row);
std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject);

}  // namespace defocus
