#pragma once
// Checks the nesting depth of JSON text before it is parsed.

#include <string_view>

namespace defocus::engine {

// Maximum nesting depth of accepted JSON, which bounds the recursion depth of parsers. glTF and shot files need about
// ten levels.
inline constexpr int deepestJson = 64;

// Returns the maximum nesting depth of arrays and objects; also works on invalid JSON.
int jsonNesting(std::string_view text);

}  // namespace defocus::engine
