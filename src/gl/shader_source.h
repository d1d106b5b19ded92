#pragma once
// Shaders embedded in the library at build time, by their path under shaders/.

#include <map>
#include <string_view>

namespace defocus::engine {

const std::map<std::string_view, std::string_view>& embeddedShaders();

}  // namespace defocus::engine
