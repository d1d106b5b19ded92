#pragma once
// Generates GLSL declarations of the constants that shaders read. A constant has the value that the program sets, or
// else its default.

#include <string>

#include "gl/program.h"

namespace defocus::engine {

// Returns the macros of `defines`, and declarations of the constants that `source` mentions, with their values in
// `defines` or their defaults. Throws Error for an unknown constant.
std::string shaderPreamble(const ShaderDefines& defines, const std::string& source);

}  // namespace defocus::engine
