#include "eval/bench_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace defocus {

namespace {

using nlohmann::json;

struct BenchKind {
    const char* name;
    std::vector<std::string> keys;    // columns that say what was asked for
    std::vector<std::string> errors;  // columns that say how far off the image is
};

const std::vector<BenchKind>& kinds() {
    static const std::vector<BenchKind> table = {
        {"convergence", {"method", "setting", "samples"}, {"psnr", "ssim", "flip", "biasFlip"}},
        {"speedup",
         {"sweep", "samples", "fStop", "focusDistance", "lod"},
         {"psnrFull", "ssimFull", "flipFull", "psnrReference", "ssimReference", "flipReference"}},
    };
    return table;
}

// A row as texts by column.
using Cells = std::map<std::string, std::string>;

std::optional<double> numberIn(const Cells& cells, const std::string& column) {
    const auto found = cells.find(column);
    if (found == cells.end()) return {};
    const std::string& text = found->second;
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

BenchRow rowOf(const Cells& cells, const BenchKind& kind, const std::string& name) {
    BenchRow row;
    for (const std::string& column : kind.keys) {
        // 2.8 from CSV and from JSON are one.
        const std::optional<double> number = numberIn(cells, column);
        row.key += (row.key.empty() ? "" : " ") + (number ? fmt::format("{:.6g}", *number) : cells.at(column));
    }
    const std::array<std::optional<double>, 3> times = {numberIn(cells, "milliseconds"), numberIn(cells, "low"),
                                                        numberIn(cells, "high")};
    if (!times[0] || !times[1] || !times[2]) fail("{}: the row '{}' has no times", name, row.key);
    row.milliseconds = {*times[0], *times[1], *times[2]};
    for (const std::string& column : kind.errors)
        if (const std::optional<double> error = numberIn(cells, column)) row.errors[column] = *error;
    return row;
}

const BenchKind& kindOf(const Cells& cells, const std::string& name) {
    for (const BenchKind& kind : kinds())
        if (std::ranges::all_of(kind.keys, [&](const std::string& key) { return cells.contains(key); })) return kind;
    fail("{}: holds neither results of bench convergence nor of bench speedup", name);
}

// ---- CSV ------------------------------------------------------------------------------------------------------------

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::vector<Cells> cellsOfCsv(std::string_view text, const std::string& name) {
    std::vector<std::string> lines = split(text, '\n');
    for (std::string& line : lines)
        if (line.ends_with('\r')) line.pop_back();
    const std::vector<std::string> columns = split(lines.front(), ',');
    std::vector<Cells> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (lines[i].empty()) continue;
        const std::vector<std::string> values = split(lines[i], ',');
        if (values.size() != columns.size())
            fail("{}: line {} has {} values instead of {}", name, i + 1, values.size(), columns.size());
        Cells& cells = rows.emplace_back();
        for (std::size_t c = 0; c < columns.size(); ++c) cells[columns[c]] = values[c];
    }
    return rows;
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

std::string textOf(const json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

// Names that are nested in JSON have one of their own in CSV.
void addNested(Cells& cells, const std::string& name, const json& value) {
    static const std::map<std::string, std::string> endings = {{"fromFullDetail", "Full"},
                                                               {"fromReference", "Reference"}};
    for (const auto& [part, inner] : value.items()) {
        if (name == "milliseconds")
            cells[part == "median" ? name : part] = textOf(inner);
        else if (name == "bias" && part == "flip")
            cells["biasFlip"] = textOf(inner);
        else if (endings.contains(name))
            cells[part + endings.at(name)] = textOf(inner);
    }
}

std::vector<Cells> cellsOfJson(const json& document, const std::string& name) {
    if (!document.is_object() || !document.contains("rows") || !document["rows"].is_array())
        fail("{}: holds no rows of a bench", name);
    std::vector<Cells> rows;
    for (const json& row : document["rows"]) {
        if (!row.is_object()) fail("{}: holds a row that is none", name);
        Cells& cells = rows.emplace_back();
        for (const auto& [key, value] : row.items()) {
            if (value.is_object())
                addNested(cells, key, value);
            else
                cells[key] = textOf(value);
        }
    }
    return rows;
}

std::string measuredOn(const json& document) {
    std::string text;
    for (const char* key : {"program", "commit", "scene", "width", "height", "device", "driver"})
        if (document.contains(key)) text += (text.empty() ? "" : ", ") + textOf(document[key]);
    return text;
}

// ---- differences ----------------------------------------------------------------------------------------------------

const BenchRow* find(const BenchResults& results, const std::string& key) {
    const auto found = std::ranges::find(results.rows, key, &BenchRow::key);
    return found == results.rows.end() ? nullptr : &*found;
}

double ratioOf(double after, double before) {
    return before > 0 ? after / before : std::numeric_limits<double>::infinity();
}

RowDifference differenceOf(const BenchRow& before, const BenchRow& after) {
    RowDifference row;
    row.key = before.key;
    row.before = before.milliseconds;
    row.after = after.milliseconds;
    row.ratio = ratioOf(row.after.median, row.before.median);
    row.leastRatio = ratioOf(row.after.low, row.before.high);
    row.mostRatio = ratioOf(row.after.high, row.before.low);
    if (row.after.high < row.before.low) row.change = TimeChange::faster;
    if (row.after.low > row.before.high) row.change = TimeChange::slower;
    for (const auto& [column, error] : after.errors)
        if (const auto old = before.errors.find(column); old != before.errors.end())
            row.errors[column] = error - old->second;
    return row;
}

std::string rowText(const RowDifference& row, std::size_t keyWidth) {
    constexpr std::array words = {"within noise", "faster", "slower"};
    std::string text =
        fmt::format("{:<{}} {:>10.1f} {:>10.1f} {:>6.3f} {:>15} {:<12}", row.key, keyWidth, row.before.median,
                    row.after.median, row.ratio, fmt::format("{:.3f} to {:.3f}", row.leastRatio, row.mostRatio),
                    words[static_cast<std::size_t>(row.change)]);
    for (const auto& [column, difference] : row.errors) text += fmt::format("  {} {:+.4g}", column, difference);
    return text + '\n';
}

}  // namespace

BenchResults parseBenchResults(std::string_view text, const std::string& name) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    const bool isJson = start != std::string_view::npos && text[start] == '{';
    const json document = isJson ? json::parse(text, nullptr, false) : json();
    if (document.is_discarded()) fail("{}: is no whole JSON file", name);

    BenchResults results;
    const std::vector<Cells> rows = isJson ? cellsOfJson(document, name) : cellsOfCsv(text, name);
    if (rows.empty()) fail("{}: holds no results", name);
    const BenchKind& kind = kindOf(rows.front(), name);
    results.bench = kind.name;
    if (isJson) results.measuredOn = measuredOn(document);
    for (const Cells& cells : rows) {
        if (&kindOf(cells, name) != &kind) fail("{}: holds rows of different benches", name);
        results.rows.push_back(rowOf(cells, kind, name));
    }
    return results;
}

BenchDifference diffBenches(const BenchResults& before, const BenchResults& after) {
    if (before.bench != after.bench)
        fail("bench {} and bench {}: only results of one bench can be compared", before.bench, after.bench);
    BenchDifference difference;
    for (const BenchRow& row : before.rows) {
        if (const BenchRow* other = find(after, row.key))
            difference.rows.push_back(differenceOf(row, *other));
        else
            difference.onlyBefore.push_back(row.key);
    }
    for (const BenchRow& row : after.rows)
        if (find(before, row.key) == nullptr) difference.onlyAfter.push_back(row.key);
    return difference;
}

std::string benchDifferenceTable(const BenchResults& before, const BenchResults& after) {
    const BenchDifference difference = diffBenches(before, after);
    std::string text;
    if (!before.measuredOn.empty()) text += "old: " + before.measuredOn + '\n';
    if (!after.measuredOn.empty()) text += "new: " + after.measuredOn + '\n';

    std::size_t width = 4;
    for (const RowDifference& row : difference.rows) width = std::max(width, row.key.size());
    text += fmt::format("{:<{}} {:>10} {:>10} {:>6} {:>15} {:<12}  errors, new minus old\n", "row", width, "old ms",
                        "new ms", "ratio", "10-90 %", "time");
    for (const RowDifference& row : difference.rows) text += rowText(row, width);
    for (const std::string& key : difference.onlyBefore) text += "only in old: " + key + '\n';
    for (const std::string& key : difference.onlyAfter) text += "only in new: " + key + '\n';

    const auto count = [&](TimeChange change) {
        return std::ranges::count(difference.rows, change, &RowDifference::change);
    };
    return text + fmt::format("{} rows: {} faster, {} slower, {} within noise (spreads of 10-90 % that touch)\n",
                              difference.rows.size(), count(TimeChange::faster), count(TimeChange::slower),
                              count(TimeChange::none));
}

}  // namespace defocus
