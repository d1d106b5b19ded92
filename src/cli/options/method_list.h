#pragma once
// Parses lists of methods on the command line.

#include <string>
#include <vector>

#include "render/methods.h"

namespace defocus::engine {

// Parses a list of methods: "a:x=1,y=2,b" is method a with two settings, then method b. A part such as "y=2", without a
// method's name, is a setting of the preceding method. Throws Error for an unknown method or setting, and for a value
// out of range.
std::vector<MethodUse> parseMethods(const std::string& text);

}  // namespace defocus::engine
