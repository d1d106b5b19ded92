#include <thread>

#include "gl/context.h"
#include "gl/gl_test.h"

namespace defocus::engine {
namespace {

using Context = GlTest;

TEST_F(Context, isCurrentAndSaysWhatItRunsOn) {
    EXPECT_FALSE(context().device().empty());
    EXPECT_EQ(context().device(), currentDevice());
    EXPECT_EQ(context().driver(), currentDriver());
    EXPECT_EQ(context().software(), currentIsSoftware());
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(10 * major + minor, 45);
    ASSERT_FALSE(context().log().empty());
    EXPECT_NE(context().log().back().find(context().device()), std::string::npos) << context().log().back();
}

// A second thread can create its own context. Destroying that context leaves this thread's context intact.
TEST_F(Context, anotherThreadMayHaveItsOwn) {
    const Buffer kept(4);
    std::thread([] {
        const std::unique_ptr<GlContext> other = createHeadlessContext();
        EXPECT_FALSE(currentDevice().empty());
        const Buffer buffer(4);
        EXPECT_TRUE(buffer);
    }).join();
    EXPECT_EQ(glIsBuffer(kept.name()), GL_TRUE);
    EXPECT_EQ(context().device(), currentDevice());
}

TEST(DrivingThreads, needALaterMesaForLlvmpipe) {
    const auto llvmpipe = [](const char* driver) { return drawsInThreads("llvmpipe (LLVM 15.0.6, 256 bits)", driver); };
    EXPECT_FALSE(llvmpipe("4.5 (Core Profile) Mesa 22.3.6"));
    EXPECT_FALSE(llvmpipe("4.5 (Core Profile) Mesa 24.3.4"));
    EXPECT_TRUE(llvmpipe("4.5 (Core Profile) Mesa 25.0.7-2~bpo12+1"));
    EXPECT_FALSE(llvmpipe("4.5"));
    EXPECT_FALSE(drawsInThreads("zink Vulkan 1.4(llvmpipe (LLVM 19))", "4.5 (Core Profile) Mesa 25.0.7"));
    EXPECT_TRUE(drawsInThreads("NVIDIA H200/PCIe/SSE2", "4.5.0 NVIDIA 550.54"));
}

}  // namespace
}  // namespace defocus::engine
