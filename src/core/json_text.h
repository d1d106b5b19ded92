#pragma once
// JSON text, looked at before it is parsed.

#include <string_view>

namespace defocus::engine {

// glTF and shots need ten levels. What works on parsed JSON may recurse: deeper, it would only cost stack.
inline constexpr int deepestJson = 64;

// How deep the text's arrays and objects nest, whether or not it is valid.
int jsonNesting(std::string_view text);

}  // namespace defocus::engine
