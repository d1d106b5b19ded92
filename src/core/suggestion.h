#pragma once
// "Did you mean …": the known word nearest to a mistyped one.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

// Empty when nothing is near: more edits than a third of the word, and than one. Edits are insertions, deletions,
// substitutions and swaps of neighbours (optimal string alignment; Damerau 1964). Capitals of ASCII count as their
// small letters.
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);

// The first place of a name that a person gave: of the name itself, or else of the only spelling that differs from it
// in capitals of ASCII alone.
std::optional<std::size_t> placeOfName(std::string_view name, const std::vector<std::string>& known);

}  // namespace defocus::engine
