#pragma once
// Writes the rows of the prediction benchmark as a text table, CSV and JSON.

#include <span>
#include <string>

#include "eval/bench_subject.h"
#include "eval/prediction/prediction.h"

namespace defocus::engine {

std::string predictionHeader();                        // returns the table's header, two lines
std::string predictionLine(const PredictionRow& row);  // returns the table's line for a row

// Returns a sentence that states for how many used levels (PredictionRow::used) predicted and rendered error differ by
// at most a factor of two. It also states the largest factor and the mean of predicted / rendered.
std::string predictionSummary(std::span<const PredictionRow> rows);

std::string predictionCsv(std::span<const PredictionRow> rows);
std::string predictionJson(std::span<const PredictionRow> rows, const BenchSubject& subject);

}  // namespace defocus::engine
