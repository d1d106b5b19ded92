#pragma once
// Suggests the known word closest to a mistyped one: "Did you mean …".

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

// Returns the known word with the smallest edit distance to `word`. The distance must be at most 1, or at most a third
// of the length of `word` if that is larger. Edits are insertions, deletions, substitutions and swaps of neighbouring
// characters (optimal string alignment; Damerau 1964). If no known word is that close, returns the shortest known word
// that contains `word`, if `word` has at least three letters; else returns an empty string. ASCII case is ignored.
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);

// Returns the index of `name` in `known`. An exact match takes precedence; otherwise ASCII case is ignored. Returns
// nullopt without a match, or if `known` has several spellings that differ only in case.
std::optional<std::size_t> placeOfName(std::string_view name, const std::vector<std::string>& known);

}  // namespace defocus::engine
