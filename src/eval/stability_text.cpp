#include "eval/stability_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/json_number.h"

namespace defocus {

namespace {

using nlohmann::ordered_json;

std::string verdict(const StabilityRow& row) {
    if (std::isinf(row.subject.limit)) return "for comparison";
    return row.passed() ? "ok" : "FAILED";
}

}  // namespace

std::string stabilityHeader() {
    return fmt::format("{:<7} {:<50} {:<31} {:<23} {:>9} {:>10}  {}\n", "area", "case", "error of", "against", "limit",
                       "error", "verdict");
}

std::string stabilityLine(const StabilityRow& row) {
    const StabilityCase& s = row.subject;
    const std::string limit = std::isinf(s.limit) ? "" : fmt::format("{:.2g}", s.limit);
    return fmt::format("{:<7} {:<50} {:<31} {:<23} {:>9} {:>10.2g}  {}\n", s.area, s.name, s.measured, s.truth, limit,
                       row.error, verdict(row));
}

std::string honestyHeader() {
    return fmt::format("{:<18} {:<20} {:>12} {:>12} {:>9} {:>9}\n", "method", "varied", "formula, px", "measured, px",
                       "off by", "energy");
}

std::string honestyLine(const HonestyRow& row) {
    return fmt::format("{:<18} {:<20} {:>12.2f} {:>12.2f} {:>9.2f} {:>9.4f}\n", row.method, row.varied, row.expected,
                       row.measured, row.measured - row.expected, row.energy);
}

std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject) {
    ordered_json document = subjectJson("stability", subject);
    document["cases"] = ordered_json::array();
    for (const StabilityRow& row : rows)
        document["cases"].push_back({{"area", row.subject.area},
                                     {"case", row.subject.name},
                                     {"errorOf", row.subject.measured},
                                     {"against", row.subject.truth},
                                     {"limit", jsonNumber(row.subject.limit)},
                                     {"error", jsonNumber(row.error)},
                                     {"passed", row.passed()}});
    document["lensHonesty"] = ordered_json::array();
    for (const HonestyRow& row : honesty)
        document["lensHonesty"].push_back({{"method", row.method},
                                           {"varied", row.varied},
                                           {"expectedDiameter", jsonNumber(row.expected)},
                                           {"measuredDiameter", jsonNumber(row.measured)},
                                           {"energy", jsonNumber(row.energy)}});
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace defocus
