#pragma once
// The shaders that were embedded when the library was built, by their path under shaders/.

#include <map>
#include <string_view>

namespace defocus::engine {

const std::map<std::string_view, std::string_view>& embeddedShaders();

}  // namespace defocus::engine
