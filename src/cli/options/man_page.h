#pragma once
// The manual page, defocus(1).

#include <string>

#include "cli/options/program_outline.h"

namespace defocus::engine {

// In the language of groff's man macros. A setting that several commands take is explained once.
std::string manPage(const CommandOutline& program);

}  // namespace defocus::engine
