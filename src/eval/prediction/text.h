#pragma once
// Writes the rows of the prediction benchmark as a table for people, as CSV and as JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/prediction/prediction.h"

namespace defocus::engine {

std::string predictionHeader();                        // two lines
std::string predictionLine(const PredictionRow& row);  // one line

// Says in a sentence how many of the levels that are used are predicted within a factor of two, how far off the worst
// one is, and how far the mean.
std::string predictionSummary(std::span<const PredictionRow> rows);

std::string predictionCsv(std::span<const PredictionRow> rows);
std::string predictionJson(std::span<const PredictionRow> rows, const BenchSubject& subject);

}  // namespace defocus::engine
