// Watches the OpenGL calls of all tests in an executable:
// - Every context is a debug context. Driver messages of high or medium severity fail the running test. Tests that
//   cause them on purpose use ExpectedGlMessages (gl_conduct.h).
// - After all tests, Khronos's glslangValidator checks every shader. It accepts only GLSL 4.50 core and the extensions
//   that the shader names; a driver may accept more.
// - If DEFOCUS_EXPECTED_DRIVER is set in the environment, all tests skip on other drivers.
//
// libepoxy calls OpenGL and EGL through pointers. This file redirects the pointers of a few functions.

#include "gl_conduct.h"

// libepoxy's headers must precede the system's EGL headers
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

std::mutex mutex;
int expected = 0;                                       // number of live ExpectedGlMessages objects
std::set<std::pair<std::string, std::string>> shaders;  // pairs of the stage's file extension and the shader's source
std::map<GLuint, const char*> stages;                   // stage of each shader object that has not been deleted

const char* extensionOf(GLenum stage) {
    switch (stage) {
        case GL_VERTEX_SHADER:
            return "vert";
        case GL_TESS_CONTROL_SHADER:
            return "tesc";
        case GL_TESS_EVALUATION_SHADER:
            return "tese";
        case GL_GEOMETRY_SHADER:
            return "geom";
        case GL_FRAGMENT_SHADER:
            return "frag";
        default:
            return "comp";
    }
}

// Redirects a function pointer of libepoxy to `mine` and keeps its original value. At first, this value is libepoxy's
// resolver, which looks up the driver's function and stores it in the pointer. The pointer is therefore restored during
// the first call. Later calls use the driver's function directly, so that the pointer stays redirected for all threads.
template <typename Function>
class Detour {
public:
    Detour(Function& pointer, Function mine) : pointer_(pointer), mine_(mine), before_(pointer) { pointer_ = mine_; }

    template <typename... Arguments>
    auto call(Arguments... arguments) {
        std::unique_lock lock(mutex_);
        if (resolved_) {
            lock.unlock();
            return before_(arguments...);
        }
        pointer_ = before_;
        const Restored restored{*this};
        return pointer_(arguments...);
    }

private:
    struct Restored {
        Detour& detour;
        ~Restored() {
            detour.before_ = detour.pointer_;
            detour.pointer_ = detour.mine_;
            detour.resolved_ = true;
        }
    };

    std::mutex mutex_;
    Function& pointer_;
    Function mine_;
    Function before_;
    bool resolved_ = false;  // whether before_ holds the driver's function instead of libepoxy's resolver
};

GLuint EPOXY_CALLSPEC createShader(GLenum stage);
void EPOXY_CALLSPEC shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths);
EGLContext EPOXY_CALLSPEC createContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                        const EGLint* attributes);
EGLBoolean EPOXY_CALLSPEC makeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context);

Detour toCreateShader(epoxy_glCreateShader, &createShader);
Detour toShaderSource(epoxy_glShaderSource, &shaderSource);
Detour toCreateContext(epoxy_eglCreateContext, &createContext);
Detour toMakeCurrent(epoxy_eglMakeCurrent, &makeCurrent);

GLuint EPOXY_CALLSPEC createShader(GLenum stage) {
    const GLuint shader = toCreateShader.call(stage);
    const std::scoped_lock lock(mutex);
    stages[shader] = extensionOf(stage);
    return shader;
}

void EPOXY_CALLSPEC shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    {
        const std::scoped_lock lock(mutex);
        if (count == 1 && lengths == nullptr && expected == 0) shaders.emplace(stages[shader], texts[0]);
    }
    toShaderSource.call(shader, count, texts, lengths);
}

EGLContext EPOXY_CALLSPEC createContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                        const EGLint* attributes) {
    std::vector<EGLint> all;
    for (; *attributes != EGL_NONE; attributes += 2) all.insert(all.end(), {attributes[0], attributes[1]});
    all.insert(all.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE, EGL_NONE});
    return toCreateContext.call(display, config, share, static_cast<const EGLint*>(all.data()));
}

void EPOXY_CALLSPEC report(GLenum /*source*/, GLenum type, GLuint id, GLenum severity, GLsizei length,
                           const GLchar* text, const void* /*user*/) {
    if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
    const std::string_view said(text,
                                length < 0 ? std::char_traits<char>::length(text) : static_cast<std::size_t>(length));
    // NVIDIA's driver recompiles a shader for the state of its first draw and reports the recompilation.
    if (type == GL_DEBUG_TYPE_PERFORMANCE && said.find("is being recompiled") != std::string_view::npos) return;
    const std::scoped_lock lock(mutex);
    if (expected > 0) return;
    ADD_FAILURE() << "OpenGL reports (" << id << "): " << said;
}

EGLBoolean EPOXY_CALLSPEC makeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
    const EGLBoolean made = toMakeCurrent.call(display, draw, read, context);
    if (made == EGL_TRUE && context != EGL_NO_CONTEXT) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(report, nullptr);
    }
    return made;
}

// Returns a command's output and whether it succeeded.
std::pair<std::string, bool> outputOf(const std::string& command) {
    std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return {"popen failed", false};
    std::string output;
    std::array<char, 4096> buffer{};
    for (std::size_t read = 0; (read = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        output.append(buffer.data(), read);
    return {output, pclose(pipe) == 0};
}

const char* expectedDriver() {
    return std::getenv("DEFOCUS_EXPECTED_DRIVER");
}

class Conduct : public testing::Environment {
public:
    void SetUp() override {
        const char* const driver = expectedDriver();
        if (driver == nullptr) return;
        std::string found = "no OpenGL";
        try {
            found = createHeadlessContext()->device();
        } catch (const Error& error) {
            found = error.what();
        }
        if (found.find(driver) == std::string::npos) GTEST_SKIP() << "skipped: no " << driver << " but " << found;
    }

    void TearDown() override {
        if (shaders.empty()) return;
        if (!outputOf("command -v glslangValidator").second) {
            std::puts(
                "glslangValidator isn't there (Debian: glslang-tools): no shader was held against GLSL 4.50 core");
            return;
        }
        const ScratchFolder folder;
        const std::string validate = "cd '" + folder.path().string() + "' && glslangValidator ";
        std::map<std::string, const std::string*> files;
        for (const auto& [extension, text] : shaders) {
            const std::string name = std::to_string(files.size()) + '.' + extension;
            std::ofstream(folder / name) << text;
            files[name] = &text;
        }
        // Validates all shaders in one run. If that fails, validates them one by one to find the invalid ones.
        if (!outputOf(validate + "*.*").second)
            for (const auto& [name, text] : files) {
                const auto [output, valid] = outputOf(validate + name);
                EXPECT_TRUE(valid) << output << "The shader begins:\n" << text->substr(0, 400);
            }
        std::printf("%zu shaders held against GLSL 4.50 core\n", shaders.size());
    }
};

[[maybe_unused]] const testing::Environment* const conduct = testing::AddGlobalTestEnvironment(new Conduct);

}  // namespace

bool onSecondDriver() {
    return expectedDriver() != nullptr;
}

ExpectedGlMessages::ExpectedGlMessages() {
    const std::scoped_lock lock(mutex);
    ++expected;
}

ExpectedGlMessages::~ExpectedGlMessages() {
    const std::scoped_lock lock(mutex);
    --expected;
}

}  // namespace defocus::engine
