#pragma once

#include <string_view>

namespace defocus::engine {

// docs/shot.schema.json, as it was when the program was built.
std::string_view shotSchemaText();

}  // namespace defocus::engine
