#include "eval/csv.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace defocus::engine {

namespace {

using nlohmann::ordered_json;

std::string fieldText(const ordered_json& value) {
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    if (value.is_number_float() && !std::isfinite(value.get<double>())) return "";
    if (!value.is_string()) return value.dump();
    const auto& text = value.get_ref<const std::string&>();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

// Returns the name of the column of a value, given its JSON pointer in the row.
std::string columnOf(std::string pointer) {
    std::ranges::replace(pointer, '/', '.');
    return pointer.substr(1);
}

}  // namespace

std::string csvText(const ordered_json& rows) {
    std::vector<ordered_json> flat;
    std::vector<std::string> columns;
    for (const ordered_json& row : rows) {
        flat.push_back(row.flatten());
        for (const auto& [pointer, value] : flat.back().items())
            if (!value.is_null() && std::ranges::find(columns, pointer) == columns.end()) columns.push_back(pointer);
    }
    std::string text;
    for (const std::string& column : columns) text += (text.empty() ? "" : ",") + columnOf(column);
    text += '\n';
    for (const ordered_json& row : flat) {
        for (const std::string& column : columns) {
            const auto found = row.find(column);
            if (column != columns.front()) text += ',';
            if (found != row.end() && !found->is_null()) text += fieldText(*found);
        }
        text += '\n';
    }
    return text;
}

}  // namespace defocus::engine
