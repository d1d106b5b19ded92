#include "gl/program.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "gl/shader_constants.h"
#include "gl/shader_source.h"

namespace defocus::engine {

namespace {

struct Stage {
    GLenum type;
    const char* name;
};

Stage stageOf(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".vert") return {GL_VERTEX_SHADER, "vertex"};
    if (extension == ".tesc") return {GL_TESS_CONTROL_SHADER, "tessellation control"};
    if (extension == ".tese") return {GL_TESS_EVALUATION_SHADER, "tessellation evaluation"};
    if (extension == ".geom") return {GL_GEOMETRY_SHADER, "geometry"};
    if (extension == ".frag") return {GL_FRAGMENT_SHADER, "fragment"};
    if (extension == ".comp") return {GL_COMPUTE_SHADER, "compute"};
    fail("shader {}: unknown extension; expected .vert, .tesc, .tese, .geom, .frag or .comp", path);
}

std::string sourceOf(const std::string& path, const std::filesystem::path& overrideFolder) {
    if (!overrideFolder.empty() && std::filesystem::exists(overrideFolder / path))
        return readText(overrideFolder / path);
    const auto found = embeddedShaders().find(path);
    if (found == embeddedShaders().end()) fail("shader {}: file not found", path);
    return std::string(found->second);
}

// Returns the source of shader `path` with includes expanded. `including` holds the files being expanded, to detect
// cycles.
std::string expanded(const std::string& path, const std::filesystem::path& overrideFolder,
                     std::set<std::string>& including) {
    if (!including.insert(path).second) fail("shader {}: the file includes itself", path);
    std::istringstream source(sourceOf(path, overrideFolder));
    std::string result;
    std::string line;
    for (int number = 1; std::getline(source, line); ++number) {
        constexpr std::string_view directive = "#include \"";
        if (!line.starts_with(directive)) {
            result += line + '\n';
            continue;
        }
        const std::size_t end = line.find('"', directive.size());
        if (end == std::string::npos) fail("shader {}:{}: the closing quote of #include is missing", path, number);
        result += "#line 1\n" +
                  expanded(line.substr(directive.size(), end - directive.size()), overrideFolder, including) +
                  fmt::format("#line {}\n", number + 1);
    }
    including.erase(path);
    return result;
}

// Returns the #version and #extension directives of a shader stage. The extensions let a shader before the geometry
// stage write gl_Layer.
std::string directivesOf(const Stage& stage) {
    std::string text = "#version 450 core\n";
    if (stage.type == GL_VERTEX_SHADER || stage.type == GL_TESS_EVALUATION_SHADER)
        text += "#extension GL_ARB_shader_viewport_layer_array : enable\n";
    if (stage.type == GL_VERTEX_SHADER) text += "#extension GL_AMD_vertex_shader_layer : enable\n";
    return text;
}

// Returns the info log of a shader or program on one line, for the message of an Error. `read`: glGetShaderInfoLog or
// glGetProgramInfoLog.
std::string logOf(GLuint name, const auto& read) {
    std::string log(8192, '\0');
    GLsizei length = 0;
    read(name, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
    for (std::size_t at = log.find('\n'); at != std::string::npos; at = log.find('\n', at)) log.replace(at, 1, " | ");
    return log;
}

GLuint compiled(const std::string& path, const ProgramInfo& info) {
    const Stage stage = stageOf(path);
    const std::string text = shaderText(path, info.defines, info.overrideFolder);
    const char* source = text.c_str();
    const GLuint shader = glCreateShader(stage.type);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    const std::string log = logOf(shader, glGetShaderInfoLog);
    glDeleteShader(shader);
    fail("{} shader {} does not compile: {}", stage.name, path, log);
}

}  // namespace

std::string shaderText(const std::string& path, const ShaderDefines& defines,
                       const std::filesystem::path& overrideFolder) {
    std::set<std::string> including;
    const std::string source = expanded(path, overrideFolder, including);
    return directivesOf(stageOf(path)) + shaderPreamble(defines, source) + "#line 1\n" + source;
}

Program::Program(const ProgramInfo& info) : handle_(glCreateProgram()) {
    std::string names;
    for (const std::string& path : info.shaders) {
        const GLuint shader = compiled(path, info);
        glAttachShader(name(), shader);
        glDeleteShader(shader);  // only flags the shader; the driver deletes it with the program
        names += (names.empty() ? "" : ", ") + path;
    }
    glLinkProgram(name());
    GLint ok = 0;
    glGetProgramiv(name(), GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return;
    fail("shaders {} do not link: {}", names, logOf(name(), glGetProgramInfoLog));
}

bool vertexShaderMayPickLayer() {
    return epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array") ||
           epoxy_has_gl_extension("GL_AMD_vertex_shader_layer");
}

bool tessellationMayPickLayer() {
    return epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array");
}

}  // namespace defocus::engine
