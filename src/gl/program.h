#pragma once
// A linked shader program. Sources come from the shaders embedded in the library, or from a folder that overrides them.
//
// `#include "path"` (relative to shaders/) is resolved here, each time it stands. Every `#line` keeps the file's own
// line numbers, so that the driver's log can be read.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gl/handle.h"

namespace defocus::engine {

using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

struct ProgramInfo {
    std::vector<std::string> shaders;  // paths under shaders/; the extension names the stage: .vert .geom .frag .comp
    ShaderDefines defines;
    std::filesystem::path overrideFolder;  // empty: the embedded shaders only
};

class Program {
public:
    Program() = default;
    // Throws Error with the stage, the shader's name and the driver's log.
    explicit Program(const ProgramInfo& info);

    void use() const { glUseProgram(handle_.name()); }
    [[nodiscard]] GLuint name() const { return handle_.name(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }

private:
    GlHandle<destroyProgram> handle_;
};

// The text of a shader with includes and defines in place (for tests and messages).
std::string shaderText(const std::string& path, const ShaderDefines& defines,
                       const std::filesystem::path& overrideFolder);

// Whether the vertex shader may write gl_Layer (ARB_shader_viewport_layer_array or AMD_vertex_shader_layer).
bool vertexShaderMayPickLayer();

}  // namespace defocus::engine
