#pragma once
// Writes rows of JSON values as CSV, so that the CSV and the JSON file of a bench have the same values and names.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>

namespace defocus::engine {

// Returns a JSON array of objects as CSV with a header (RFC 4180, but with LF line ends). Each value has a column. The
// name of a column joins the names of nested objects with dots, such as "milliseconds.median". Columns have the order
// in which the rows first contain a value other than null; a field is empty where a row has no such value, or has
// NaN or infinity. Booleans are 1 and 0.
std::string csvText(const nlohmann::ordered_json& rows);

// Returns csvText() of `rows` after conversion with `rowJson`.
template <typename Row>
std::string csvText(std::span<const Row> rows, nlohmann::ordered_json (*rowJson)(const std::type_identity_t<Row>&)) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Row& row : rows) all.push_back(rowJson(row));
    return csvText(all);
}

}  // namespace defocus::engine
