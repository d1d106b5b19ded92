#include <algorithm>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/program.h"
#include "gl_conduct.h"

namespace defocus::engine {
namespace {

class GlProgram : public GlTest {
protected:
    [[nodiscard]] std::string faultOf(std::vector<std::string> shaders) const {
        try {
            const Program built = program(std::move(shaders));
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    }
};

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Returns whether a compiler message refers to `line`. For line 7, Mesa writes 0:7(12) and NVIDIA 0(7).
bool pointsAtLine(const std::string& fault, int line) {
    const std::string number = std::to_string(line);
    return says(fault, "0:" + number + "(") || says(fault, "0(" + number + ")");
}

TEST_F(GlProgram, definesReachTheShader) {
    writeShader("defined.frag", "out vec4 value;\nvoid main() { value = vec4(FIRST, SECOND, 0, 1); }\n");
    const Image image =
        computed(program({fullscreenShader, "defined.frag"}, {{"FIRST", "0.25"}, {"SECOND", "8"}}), 2, 2);
    EXPECT_EQ(image.at(1, 1)[0], 0.25f);
    EXPECT_EQ(image.at(1, 1)[1], 8);
}

TEST_F(GlProgram, constantsHaveTheValueOfTheProgramOrTheirDefault) {
    writeShader("constants.frag",
                "#ifdef LIT\nconst float passed = 1.0;\n#else\nconst float passed = 0.0;\n#endif\nout vec4 value;\n"
                "void main() { value = vec4(lit ? 1.0 : 0.0, passed, lightCount, 1); }\n");
    const Image unchanged = computed(program({fullscreenShader, "constants.frag"}), 1, 1);
    EXPECT_EQ(unchanged.at(0, 0)[0], 0);
    EXPECT_EQ(unchanged.at(0, 0)[1], 0);
    EXPECT_EQ(unchanged.at(0, 0)[2], 0);
    const Image set =
        computed(program({fullscreenShader, "constants.frag"}, {{"lightCount", "3"}, {"lit", "true"}}), 1, 1);
    EXPECT_EQ(set.at(0, 0)[0], 1);
    EXPECT_EQ(set.at(0, 0)[1], 1);
    EXPECT_EQ(set.at(0, 0)[2], 3);
}

TEST_F(GlProgram, unknownConstantsAreErrors) {
    try {
        const Program built = program({fullscreenShader, "add.frag"}, {{"lightCounts", "3"}});
        FAIL() << "the constant 'lightCounts' was accepted";
    } catch (const Error& error) {
        EXPECT_TRUE(says(error.what(), "unknown constant 'lightCounts'")) << error.what();
    }
}

TEST_F(GlProgram, includesStandWhereTheyAreNamedEachTime) {
    writeShader("parts/one.glsl", "sum += 1.0;\n");
    writeShader("included.frag",
                "out vec4 value;\nvoid main() {\nfloat sum = 0.0;\n#include \"parts/one.glsl\"\n"
                "#include \"parts/one.glsl\"\nvalue = vec4(sum);\n}\n");
    EXPECT_EQ(*computed(program({fullscreenShader, "included.frag"}), 1, 1).at(0, 0), 2);
}

TEST_F(GlProgram, theFoldersShaderReplacesTheEmbeddedOne) {
    writeShader("replaced.frag", "out vec4 value;\nvoid main() { value = vec4(1); }\n");
    // The test's shader replaces the embedded full-screen shader. It places all vertices outside the clip volume, so
    // nothing is drawn.
    writeShader(fullscreenShader, "void main() { gl_Position = vec4(2, 2, 0, 1); }\n");
    const Program nothing = program({fullscreenShader, "replaced.frag"});
    const GlTexture texture({.width = 1, .height = 1});
    const Target target({&texture});
    target.bind();
    const float zero[4] = {0, 0, 0, 0};
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, zero);
    Fullscreen().draw(nothing);
    EXPECT_EQ(*readBack(texture, 4).at(0, 0), 0);
    EXPECT_TRUE(says(shaderText(fullscreenShader, {}, folder()), "vec4(2, 2, 0, 1)"));
    EXPECT_FALSE(says(shaderText(fullscreenShader, {}, {}), "vec4(2, 2, 0, 1)"));
}

TEST_F(GlProgram, compileErrorsNameStageFileAndItsOwnLine) {
    const ExpectedGlMessages wrongOnPurpose;
    writeShader("parts/long.glsl", std::string(20, '\n') + "const float tenth = 0.1;\n");
    const std::string broken = "#include \"parts/long.glsl\"\nout vec4 value;\nvoid main() {\nvalue = nowhere;\n}\n";
    writeShader("broken.frag", broken);
    const std::string fault = faultOf({fullscreenShader, "broken.frag"});
    EXPECT_TRUE(says(fault, "fragment shader broken.frag does not compile")) << fault;
    EXPECT_TRUE(says(fault, "nowhere")) << fault;
    EXPECT_TRUE(pointsAtLine(fault, 4)) << fault;
    EXPECT_EQ(std::ranges::count(fault, '\n'), 0) << fault;
    // Errors in an included file are reported with that file's own line numbers.
    writeShader("parts/long.glsl", "\n\nfloat here = elsewhere;\n");
    const std::string inside = faultOf({fullscreenShader, "broken.frag"});
    EXPECT_TRUE(says(inside, "elsewhere") && pointsAtLine(inside, 3)) << inside;
    writeShader("broken.vert", "void main() { gl_Position = wrong; }\n");
    EXPECT_TRUE(says(faultOf({"broken.vert"}), "vertex shader broken.vert does not compile"));
}

TEST_F(GlProgram, linkErrorsNameAllShaders) {
    writeShader("giver.vert", "out vec2 handed;\nvoid main() { handed = vec2(1); gl_Position = vec4(0); }\n");
    writeShader("taker.frag", "in vec4 handed;\nout vec4 value;\nvoid main() { value = handed; }\n");
    const std::string fault = faultOf({"giver.vert", "taker.frag"});
    EXPECT_TRUE(says(fault, "shaders giver.vert, taker.frag do not link")) << fault;
    EXPECT_TRUE(says(fault, "handed")) << fault;
    EXPECT_EQ(std::ranges::count(fault, '\n'), 0) << fault;
}

TEST_F(GlProgram, badPathsAndIncludesAreErrors) {
    EXPECT_TRUE(says(faultOf({"missing.frag"}), "shader missing.frag: file not found"));
    writeShader("stage.glsl", "");
    EXPECT_TRUE(says(faultOf({"stage.glsl"}), "shader stage.glsl: unknown extension"));
    writeShader("self.frag", "\n#include \"self.frag\"\n");
    EXPECT_TRUE(says(faultOf({"self.frag"}), "shader self.frag: the file includes itself"));
    writeShader("quote.frag", "\n#include \"open.glsl\n");
    EXPECT_TRUE(says(faultOf({"quote.frag"}), "shader quote.frag:2")) << faultOf({"quote.frag"});
    writeShader("lost.frag", "#include \"parts/lost.glsl\"\n");
    EXPECT_TRUE(says(faultOf({"lost.frag"}), "shader parts/lost.glsl: file not found"));
}

}  // namespace
}  // namespace defocus::engine
