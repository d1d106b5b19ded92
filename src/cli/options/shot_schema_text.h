#pragma once

#include <string_view>

namespace defocus::engine {

// Returns the text of docs/shot.schema.json, embedded in the build.
std::string_view shotSchemaText();

}  // namespace defocus::engine
