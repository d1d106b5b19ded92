#pragma once
// Sources of the shaders embedded in the library at build time, by path relative to shaders/.

#include <map>
#include <string_view>

namespace defocus::engine {

const std::map<std::string_view, std::string_view>& embeddedShaders();

}  // namespace defocus::engine
