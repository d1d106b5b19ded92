#pragma once
// Parses lists of methods on the command line.

#include <string>
#include <vector>

#include "render/methods.h"

namespace defocus::engine {

// Parses a list of methods: "a:x=1,y=2,b" is method a with two settings, and method b. A part with "=" but without a
// method's name belongs to the method before it. Throws Error for an unknown method or setting, and for a value out of
// range.
std::vector<MethodUse> parseMethods(const std::string& text);

}  // namespace defocus::engine
