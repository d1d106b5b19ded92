#pragma once
// Declares the constants that shaders read, with a program's values or with default values.

#include <string>

#include "gl/program.h"

namespace defocus::engine {

// Returns the macros of `defines`, and declarations of the constants that `source` mentions, with their values in
// `defines` or their defaults. Throws Error for an unknown constant.
std::string shaderPreamble(const ShaderDefines& defines, const std::string& source);

}  // namespace defocus::engine
