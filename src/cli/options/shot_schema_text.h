#pragma once

#include <string_view>

namespace defocus::engine {

// Returns docs/shot.schema.json as of the program's build.
std::string_view shotSchemaText();

}  // namespace defocus::engine
