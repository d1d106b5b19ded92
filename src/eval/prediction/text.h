#pragma once
// Writes the rows of the prediction benchmark as a table for people, as CSV and as JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/prediction/prediction.h"

namespace defocus {

std::string predictionHeader();                        // two lines
std::string predictionLine(const PredictionRow& row);  // one line

// How many of the levels that are used are predicted within a factor of two, and the worst, in a sentence.
std::string predictionSummary(std::span<const PredictionRow> rows);

std::string predictionCsv(std::span<const PredictionRow> rows);
std::string predictionJson(std::span<const PredictionRow> rows, const BenchSubject& subject);

}  // namespace defocus
