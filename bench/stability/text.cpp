#include "stability/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ranges>

#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

std::string verdict(const StabilityRow& row) {
    if (row.leftOut) return "left out";
    if (std::isinf(row.subject.limit)) return "for comparison";
    return row.failed() ? "FAILED" : "ok";
}

// Pads UTF-8 text with spaces to `width` code points.
std::string padded(const std::string& text, std::size_t width) {
    const auto characters = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
    return text + std::string(width - std::min(width, characters), ' ');
}

}  // namespace

std::string stabilityLine(const StabilityRow& row, const StabilityRow* before) {
    const StabilityCase& s = row.subject;
    std::string text;
    if (!before || before->subject.area != s.area || before->subject.measured != s.measured ||
        before->subject.reference != s.reference)
        text = fmt::format("{}{} {:>9} {:>9}\n", before ? "\n" : "",
                           padded(fmt::format("{}: {}; against {}", s.area, s.measured, s.reference), 62), "limit",
                           "error");
    const std::string limit = std::isinf(s.limit) ? "" : fmt::format("{:.2g}", s.limit);
    const std::string error = row.leftOut ? "" : fmt::format("{:.2g}", row.error);
    return text + fmt::format("  {} {:>9} {:>9}  {}\n", padded(s.name, 60), limit, error, verdict(row));
}

std::string honestyHeader() {
    return fmt::format("{:<18} {:<18} {:>11} {:>12} {:>8} {:>8}  {}\n", "method", "varied", "formula, px",
                       "measured, px", "off by", "energy", "verdict");
}

std::string honestyLine(const HonestyRow& row) {
    if (!row.leftOut.empty()) return fmt::format("{:<18} left out: {}\n", row.method, row.leftOut);
    return fmt::format("{:<18} {:<18} {:>11.2f} {:>12.2f} {:>8.2f} {:>8.4f}  {}\n", row.method, row.varied,
                       row.expected, row.measured, row.measured - row.expected, row.energy,
                       row.followsLens() ? "follows" : "differs");
}

std::string honestySummary(std::span<const HonestyRow> rows) {
    std::string text =
        fmt::format("{:<30} {:>11} {:>15} {:>15}  {}\n", "method", "off by, px", "where", "energy", "follow the lens");
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t end = first;
        while (end < rows.size() && rows[end].method == rows[first].method) ++end;
        const std::span<const HonestyRow> use = rows.subspan(first, end - first);
        first = end;
        if (!use.back().leftOut.empty()) {
            text += fmt::format("{:<30} left out: {}\n", use.back().method, use.back().leftOut);
            continue;
        }
        const auto& worst = *std::ranges::max_element(
            use, {}, [](const HonestyRow& row) { return std::abs(row.measured - row.expected); });
        const auto [min, max] = std::ranges::minmax(use | std::views::transform(&HonestyRow::energy));
        const auto following = std::ranges::count_if(use, &HonestyRow::followsLens);
        text += fmt::format("{:<30} {:>11.2f} {:>15} {:>15}  {} of {}\n", worst.method, worst.measured - worst.expected,
                            worst.varied, fmt::format("{:.3f} to {:.3f}", min, max), following, use.size());
    }
    return text;
}

std::string stabilityJson(std::span<const StabilityRow> rows, std::span<const HonestyRow> honesty,
                          const BenchSubject& subject) {
    ordered_json document = subjectJson("stability", subject);
    document["cases"] = ordered_json::array();
    for (const StabilityRow& row : rows)
        document["cases"].push_back({{"area", row.subject.area},
                                     {"case", row.subject.name},
                                     {"errorOf", row.subject.measured},
                                     {"against", row.subject.reference},
                                     {"limit", jsonNumber(row.subject.limit)},
                                     {"error", jsonNumber(row.error)},
                                     {"leftOut", row.leftOut},
                                     {"passed", !row.leftOut && !row.failed()}});
    document["lensHonesty"] = ordered_json::array();
    for (const HonestyRow& row : honesty) {
        if (!row.leftOut.empty()) {
            document["lensHonesty"].push_back({{"method", row.method}, {"leftOut", row.leftOut}});
            continue;
        }
        document["lensHonesty"].push_back({{"method", row.method},
                                           {"varied", row.varied},
                                           {"expectedDiameter", jsonNumber(row.expected)},
                                           {"measuredDiameter", jsonNumber(row.measured)},
                                           {"energy", jsonNumber(row.energy)},
                                           {"followsLens", row.followsLens()}});
    }
    return documentText(document);
}

}  // namespace defocus::engine
