#include "core/json_text.h"

#include <algorithm>
#include <cstddef>

namespace defocus::engine {

// Scans the text without parsing: a parser callback of nlohmann::json would take quadratic time on long arrays.
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
