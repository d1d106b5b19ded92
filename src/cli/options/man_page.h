#pragma once
// Writes the manual page, defocus(1).

#include <string>

#include "cli/options/program_outline.h"

namespace defocus::engine {

// Returns the page in groff's man macros. A setting that several commands take is explained once.
std::string manPage(const CommandOutline& program);

}  // namespace defocus::engine
