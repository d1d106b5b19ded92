#pragma once
// Linked shader program. Shader sources are embedded in the library; files in an override folder replace them.
//
// `#include "path"` (relative to shaders/) is expanded at every occurrence, without include guards. `#line` directives
// keep each file's line numbers, so that driver logs are readable.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gl/handle.h"

namespace defocus::engine {

// Names and values for shaders. A name in capitals becomes a macro. Any other name sets one of the constants of
// shader_constants.cpp.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

struct ProgramInfo {
    std::vector<std::string> shaders;  // paths under shaders/; stage by extension: .vert .tesc .tese .geom .frag .comp
    ShaderDefines defines;
    std::filesystem::path overrideFolder;  // folder whose shaders replace embedded shaders; empty: none
};

class Program {
public:
    Program() = default;
    // Compiles and links the shaders. Throws Error with the shader's name and the driver's log if this fails.
    explicit Program(const ProgramInfo& info);

    void use() const { glUseProgram(handle_.name()); }
    [[nodiscard]] GLuint name() const { return handle_.name(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }

private:
    GlHandle<destroyProgram> handle_;
};

// Returns a shader's source with its preamble (#version, macros and constants) and with includes expanded, for tests
// and messages.
std::string shaderText(const std::string& path, const ShaderDefines& defines,
                       const std::filesystem::path& overrideFolder);

// Returns whether vertex shaders may write gl_Layer: whether the driver has GL_ARB_shader_viewport_layer_array or
// GL_AMD_vertex_shader_layer.
bool vertexShaderMayPickLayer();
// Returns whether tessellation evaluation shaders may write gl_Layer: whether the driver has
// GL_ARB_shader_viewport_layer_array.
bool tessellationMayPickLayer();

}  // namespace defocus::engine
