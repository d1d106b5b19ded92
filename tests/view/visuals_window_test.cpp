// Tests the window on screens whose colour depth is not the usual 24 bits, and on screens without OpenGL.

#include <algorithm>

#include "view/view_program.h"

namespace defocus::engine {
namespace {

class Visuals : public ViewProgram {
protected:
    static void SetUpTestSuite() {}  // starts no virtual display, since each test starts its own
    void SetUp() override {
        beginServer(screen());
        ViewProgram::SetUp();
    }
    void TearDown() override {
        ViewProgram::TearDown();
        endServer();
    }
    [[nodiscard]] virtual std::vector<std::string> screen() const = 0;
};

class Depth : public Visuals, public testing::WithParamInterface<int> {
    [[nodiscard]] std::vector<std::string> screen() const override {
        return {"-screen", "0", "640x480x" + std::to_string(GetParam())};
    }
};

TEST_P(Depth, picturesAreShown) {
    start({"--fish", "1", "--fish-triangles", "200", "--size", "320x240"});
    EXPECT_TRUE(reaches([](const nlohmann::json& s) { return s.at("samples") > 0; })) << textOf("stderr");
}

INSTANTIATE_TEST_SUITE_P(Visuals, Depth, testing::Values(16, 30));  // a colour depth of 30 has ten bits per channel

class WithoutGlx : public Visuals {
    [[nodiscard]] std::vector<std::string> screen() const override {
        return {"-screen", "0", "640x480x24", "-extension", "GLX"};
    }
};

TEST_F(WithoutGlx, theReasonIsOneLine) {
    start({"--fish", "1", "--fish-triangles", "200"});
    EXPECT_EQ(ended(), 1);
    const std::string fault = textOf("stderr");
    EXPECT_EQ(std::ranges::count(fault, '\n'), 1) << fault;
    EXPECT_NE(fault.find("cannot open a window with OpenGL 4.5: GLX"), std::string::npos) << fault;
    EXPECT_NE(fault.find("defocus render"), std::string::npos) << fault;
}

}  // namespace
}  // namespace defocus::engine
