#include "eval/prediction/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/csv.h"
#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

// Returns the larger of the predicted and the rendered error divided by the smaller one, ≥ 1.
double factorOff(const PredictionRow& row) {
    return std::max(row.predicted / row.rendered, row.rendered / row.predicted);
}

ordered_json rowJson(const PredictionRow& row) {
    return {{"mesh", row.mesh},
            {"coc", row.coc},
            {"level", row.level},
            {"triangles", row.triangles},
            {"predicted", jsonNumber(row.predicted)},
            {"rendered", jsonNumber(row.rendered)},
            {"used", row.used}};
}

}  // namespace

std::string predictionHeader() {
    return fmt::format("{:<24} {:>7} {:>6} {:>9} {:>10} {:>10} {:>7}\n{:<24} {:>7} {:>6} {:>9} {:>10} {:>10} {:>7}\n",
                       "", "CoC", "", "", "predicted", "rendered", "", "mesh", "px", "level", "triangles", "1000 x",
                       "1000 x", "ratio");
}

std::string predictionLine(const PredictionRow& row) {
    return fmt::format("{:<24} {:>7.4g} {:>6} {:>9} {:>10.3f} {:>10.3f} {:>7.2f}{}{}\n", row.mesh, row.coc,
                       row.level == 0 ? "64 smp" : fmt::format("{}", row.level), row.triangles, 1000 * row.predicted,
                       1000 * row.rendered, row.predicted / row.rendered, row.used ? "" : "  not used",
                       row.withinTwo() || !row.used ? "" : "  beyond 2");
}

std::string predictionSummary(std::span<const PredictionRow> rows) {
    std::size_t used = 0;
    std::size_t within = 0;
    double worst = 1;
    double logarithms = 0;
    for (const PredictionRow& row : rows) {
        if (!row.used || row.level == 0) continue;
        ++used;
        within += row.withinTwo() ? 1 : 0;
        worst = std::max(worst, factorOff(row));
        logarithms += std::log(row.predicted / row.rendered);
    }
    if (used == 0) return "No level is used.\n";
    return fmt::format(
        "For {} of the {} levels that are used with 16 to 512 samples, the predicted error is within a factor of 2 of "
        "the rendered\n"
        "error. The largest factor is {:.2f}; the geometric mean of predicted / rendered is {:.2f}.\n",
        within, used, worst, std::exp(logarithms / static_cast<double>(used)));
}

std::string predictionCsv(std::span<const PredictionRow> rows) {
    return csvText(rows, rowJson);
}

std::string predictionJson(std::span<const PredictionRow> rows, const BenchSubject& subject) {
    ordered_json document = subjectJson("prediction", subject);
    document["heldEqual"] =
        "mesh, level, lens, lens samples and size of the blur; rows of level 0 give the error of 64 lens samples at "
        "full detail";
    document["rows"] = ordered_json::array();
    for (const PredictionRow& row : rows) document["rows"].push_back(rowJson(row));
    return documentText(document);
}

}  // namespace defocus::engine
