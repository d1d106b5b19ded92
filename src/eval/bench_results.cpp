#include "eval/bench_results.h"

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
    bool timed = true;
    std::vector<std::string> further = {};  // keys that older results lack; empty or "accumulation" says nothing
};

const std::vector<std::string> poppingErrors = {"changeRmse",      "changeFlip",      "stepRmse",      "stepFlip",
                                                "changeRmseImage", "changeFlipImage", "stepRmseImage", "stepFlipImage"};

// The first whose keys are all there is the kind of a row.
const std::vector<BenchKind>& kinds() {
    static const std::vector<BenchKind> table = {
        {"convergence", {"method", "setting", "samples"}, {"rmse", "psnr", "ssim", "flip", "biasFlip"}},
        {"speedup",
         {"sweep", "samples", "fStop", "focusDistance", "lod"},
         {"rmseFull", "psnrFull", "ssimFull", "flipFull", "rmseReference", "psnrReference", "ssimReference",
          "flipReference"},
         true,
         {"preset", "method"}},
        {"scaling", {"axis", "value", "lod", "samples", "width", "height"}, {}},
        {"popping, frame by frame", {"movement", "samples", "lod", "frame"}, poppingErrors, false},
        {"popping", {"movement", "samples", "lod"}, poppingErrors, false},
        {"stability", {"area", "case"}, {"error"}, false},
        {"stability", {"method", "varied"}, {"diameterError", "energyError"}, false},
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

// Errors that follow from what the row says.
std::optional<double> errorIn(const Cells& cells, const std::string& column) {
    const auto difference = [](std::optional<double> a, std::optional<double> b) {
        return a && b ? std::optional(std::abs(*a - *b)) : std::nullopt;
    };
    if (column == "rmse") {
        const std::optional<double> mse = numberIn(cells, "mse");
        return mse ? std::optional(std::sqrt(*mse)) : std::nullopt;
    }
    if (column == "diameterError")
        return difference(numberIn(cells, "measuredDiameter"), numberIn(cells, "expectedDiameter"));
    if (column == "energyError") return difference(numberIn(cells, "energy"), 1);
    return numberIn(cells, column);
}

BenchRow rowOf(const Cells& cells, const BenchKind& kind, const std::string& name) {
    BenchRow row;
    for (const std::string& column : kind.keys) {
        // 2.8 from CSV and from JSON are one.
        const std::optional<double> number = numberIn(cells, column);
        row.key += (row.key.empty() ? "" : " ") + (number ? fmt::format("{:.6g}", *number) : cells.at(column));
    }
    for (const std::string& column : kind.further) {
        const auto cell = cells.find(column);
        const bool usual = cell == cells.end() || cell->second.empty() || cell->second == "accumulation";
        if (!usual) row.key += " " + cell->second;
    }
    if (kind.timed) {
        const std::array<std::optional<double>, 3> times = {numberIn(cells, "milliseconds"), numberIn(cells, "low"),
                                                            numberIn(cells, "high")};
        if (!times[0] || !times[1] || !times[2]) fail("{}: the row '{}' has no times", name, row.key);
        row.milliseconds = Spread{*times[0], *times[1], *times[2]};
        row.runs = static_cast<int>(std::clamp(numberIn(cells, "runs").value_or(0), 0.0, 1e6));
    }
    for (const std::string& column : kind.errors)
        if (const std::optional<double> error = errorIn(cells, column)) row.errors[column] = *error;
    row.limit = numberIn(cells, "limit");
    row.referenceSamples = numberIn(cells, "referenceSamples").value_or(0);
    return row;
}

const BenchKind& kindOf(const Cells& cells, const std::string& name) {
    for (const BenchKind& kind : kinds())
        if (std::ranges::all_of(kind.keys, [&](const std::string& key) { return cells.contains(key); })) return kind;
    fail("{}: holds no results of bench convergence, speedup, scaling, popping or stability", name);
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
        else if (part == "worst")  // of a movement's frames
            cells[name] = textOf(inner);
    }
}

Cells cellsOfRow(const json& row, const json& document, const std::string& name) {
    if (!row.is_object()) fail("{}: holds a row that is none", name);
    Cells cells;
    if (document.contains("runs")) cells["runs"] = textOf(document["runs"]);
    for (const auto& [key, value] : row.items()) {
        if (value.is_object())
            addNested(cells, key, value);
        else
            cells[key] = textOf(value);
    }
    return cells;
}

std::vector<Cells> cellsOfJson(const json& document, const std::string& name) {
    std::vector<Cells> rows;
    for (const char* list : {"rows", "cases", "lensHonesty"})
        if (document.contains(list) && document[list].is_array())
            for (const json& row : document[list]) rows.push_back(cellsOfRow(row, document, name));
    return rows;
}

std::string measuredOn(const json& document) {
    std::string text;
    for (const char* key : {"program", "commit", "scene", "width", "height", "device", "driver"})
        if (document.contains(key)) text += (text.empty() ? "" : ", ") + textOf(document[key]);
    return text;
}

std::map<std::string, std::string> subjectOf(const json& document) {
    std::map<std::string, std::string> subject;
    for (const char* key : {"scene", "camera", "device", "driver", "frames", "pathFrames"})
        if (document.contains(key)) subject[key] = textOf(document[key]);
    const auto part = [&](const char* name, const char* key) {
        const bool has = document.contains(name) && document[name].is_object() && document[name].contains(key);
        return has ? textOf(document[name][key]) : std::string();
    };
    if (document.contains("width") && document.contains("height"))
        subject["size"] = fmt::format("{} x {} px", textOf(document["width"]), textOf(document["height"]));
    if (document.contains("lens") && document["lens"].is_object())
        for (const auto& [field, value] : document["lens"].items()) subject["lens " + field] = textOf(value);
    if (document.contains("machine"))
        subject["machine"] = fmt::format("{}, {} threads", part("machine", "processor"), part("machine", "threads"));
    if (document.contains("reference"))
        subject["reference"] =
            fmt::format("{} samples, hash {}", part("reference", "samples"), part("reference", "hash"));
    return subject;
}

}  // namespace

BenchResults parseBenchResults(std::string_view text, const std::string& name) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    const bool isJson = start != std::string_view::npos && text[start] == '{';
    const json document = isJson ? json::parse(text, nullptr, false) : json();
    if (document.is_discarded()) fail("{}: is no whole JSON file", name);

    BenchResults results;
    const std::vector<Cells> rows = isJson ? cellsOfJson(document, name) : cellsOfCsv(text, name);
    if (rows.empty()) fail("{}: holds no results of a bench", name);
    results.bench = kindOf(rows.front(), name).name;
    if (isJson) {
        results.measuredOn = measuredOn(document);
        results.subject = subjectOf(document);
    }
    for (const Cells& cells : rows) {
        const BenchKind& kind = kindOf(cells, name);
        if (kind.name != results.bench) fail("{}: holds rows of different benches", name);
        results.rows.push_back(rowOf(cells, kind, name));
    }
    return results;
}

}  // namespace defocus
