#include "core/json_text.h"

#include <algorithm>
#include <cstddef>

namespace defocus::engine {

// (A parser's own callback could count too, but makes long arrays quadratic in nlohmann's.)
int jsonNesting(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString && c == '\\') ++i;
        if (c == '"') inString = !inString;
        if (inString) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

}  // namespace defocus::engine
