#pragma once
// "Did you mean …": the known word nearest to a mistyped one.

#include <string>
#include <string_view>
#include <vector>

namespace defocus {

// Empty when nothing is near: more edits than a third of the word. Edits are insertions, deletions, substitutions and
// swaps of neighbours (optimal string alignment; Damerau 1964).
std::string nearestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace defocus
