#pragma once
// Fixture of OpenGL tests: one context per suite and a folder for shaders. A test fails if glGetError() reports an
// error at the end of the test.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gl/fullscreen.h"
#include "gl/read_back.h"
#include "gl/target.h"
#include "gl_context_test.h"
#include "scratch_folder.h"

namespace defocus::engine {

class GlTest : public GlContextTest {
protected:
    void TearDown() override { EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}); }

    void writeShader(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((folder_ / path).parent_path());
        std::ofstream(folder_ / path) << text;
    }
    // Links a program from `shaders`: paths of embedded shaders, or of files that the test wrote.
    [[nodiscard]] Program program(std::vector<std::string> shaders, ShaderDefines defines = {}) const {
        return Program({std::move(shaders), std::move(defines), folder_.path()});
    }
    // Returns a program that covers the entire render target. The fragment code `body` assigns the vec4 `value`.
    [[nodiscard]] Program fragmentProgram(const std::string& declarations, const std::string& body) const {
        writeShader("test.frag",
                    "layout(location = 0) out vec4 value;\n" + declarations + "\nvoid main() {\n" + body + "\n}\n");
        return program({fullscreenShader, "test.frag"});
    }
    // Returns the values that `program` writes to a float target of the given size.
    [[nodiscard]] static Image computed(const Program& program, int width, int height) {
        const GlTexture texture({.format = TextureFormat::rgba32f, .width = width, .height = height});
        const Target target({&texture});
        target.bind();
        Fullscreen().draw(program);
        return readBack(texture, 4);
    }
    // Returns the texels of a mip level as a shader fetches them.
    [[nodiscard]] Image fetched(const GlTexture& texture, int level = 0) const {
        const Program fetch =
            fragmentProgram("layout(binding = 0) uniform sampler2D source;",
                            "value = texelFetch(source, ivec2(gl_FragCoord.xy), " + std::to_string(level) + ");");
        texture.attach(0);
        return computed(fetch, std::max(texture.info().width >> level, 1), std::max(texture.info().height >> level, 1));
    }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
    [[nodiscard]] static const GlContext& context() { return *context_; }

private:
    ScratchFolder folder_;
};

}  // namespace defocus::engine
