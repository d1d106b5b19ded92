#pragma once
// Suggests the known word closest to a mistyped one: "Did you mean …".

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

// Returns the closest known word, or an empty string if none is close. Close means at most one edit, or edits up to a
// third of the word's length. Edits are insertions, deletions, substitutions and swaps of neighbours (optimal string
// alignment; Damerau 1964). If no word is close, returns the shortest that contains `word`, which must then have at
// least three letters. ASCII case is ignored.
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);

// Returns the index of the name in `known`. Exact matches come first; otherwise ASCII case is ignored. Returns nullopt
// without a match, or if several different spellings match.
std::optional<std::size_t> placeOfName(std::string_view name, const std::vector<std::string>& known);

}  // namespace defocus::engine
