#pragma once
// Checks of JSON text before parsing.

#include <string_view>

namespace defocus::engine {

// Maximum nesting of accepted JSON; glTF and shots need about ten levels. Bounds the stack depth of recursive code.
inline constexpr int deepestJson = 64;

// Returns the maximum nesting depth of arrays and objects; works on invalid JSON too.
int jsonNesting(std::string_view text);

}  // namespace defocus::engine
