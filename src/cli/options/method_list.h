#pragma once
// Lists of methods on the command line.

#include <string>
#include <vector>

#include "render/methods.h"

namespace defocus::engine {

// "a:x=1,y=2,b" is a with two settings, and b: what has a "=" and no name of its own belongs to the method before it.
// Throws Error for an unknown method or setting and for a value out of range.
std::vector<MethodUse> parseMethods(const std::string& text);

}  // namespace defocus::engine
