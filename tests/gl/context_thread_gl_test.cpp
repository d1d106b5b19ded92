// Tests threads whose OpenGL contexts share objects, such as textures, with the main context.

#include <atomic>
#include <stdexcept>

#include "core/error.h"
#include "gl/context_thread.h"
#include "gl/fence.h"
#include "gl/gl_test.h"

namespace defocus::engine {
namespace {

class SharedContexts : public GlTest {
protected:
    static std::unique_ptr<ContextThread> thread() { return std::make_unique<ContextThread>(createSharedContext()); }
};

// Another thread's context draws into a texture repeatedly, and this context reads each result.
TEST_F(SharedContexts, shareTextures) {
    const auto other = thread();
    Program program;
    other
        ->add([&] { program = fragmentProgram("layout(location = 0) uniform float number;", "value = vec4(number);"); })
        .get();
    const GlTexture texture({.format = TextureFormat::rgba32f, .width = 300, .height = 200});
    for (int number = 1; number < 20; ++number) {
        other
            ->add([&] {
                const Target target({&texture});
                target.bind();
                glProgramUniform1f(program.name(), 0, static_cast<float>(number));
                Fullscreen().draw(program);
                return Fence::forOtherContexts();
            })
            .get()
            .wait();
        const Image image = fetched(texture);
        for (const float value : image.pixels) ASSERT_EQ(value, static_cast<float>(number));
    }
}

TEST_F(SharedContexts, createdContextIsNotCurrent) {
    const Buffer kept(4);
    const std::unique_ptr<GlContext> other = createSharedContext();
    EXPECT_EQ(other->software(), context().software());
    const VertexArray array;  // belongs to this context, since vertex arrays are not shared
    EXPECT_EQ(glIsBuffer(kept.name()), GL_TRUE);
}

TEST_F(SharedContexts, needACurrentContext) {
    std::thread([] { EXPECT_EQ(createSharedContext(), nullptr); }).join();
}

TEST_F(SharedContexts, tasksRunInOrder) {
    const auto other = thread();
    std::vector<int> order;
    for (int i = 0; i < 100; ++i) other->add([&order, i] { order.push_back(i); });
    other->add([] {}).get();
    ASSERT_EQ(order.size(), 100u);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST_F(SharedContexts, exceptionsReachTheCaller) {
    const auto other = thread();
    EXPECT_THROW(other->add([] { fail("no"); }).get(), Error);
    EXPECT_EQ(other->add([] { return 3; }).get(), 3);
}

TEST_F(SharedContexts, tasksAreDiscardedWithTheThread) {
    auto other = thread();
    std::promise<void> started;
    std::atomic<bool> ends = false;
    std::future<void> running = other->add([&] {
        started.set_value();
        while (!ends) std::this_thread::yield();
    });
    std::future<int> discarded = other->add([] { return 1; });
    started.get_future().get();
    std::thread closing([&] { other.reset(); });
    EXPECT_THROW(discarded.get(), std::future_error);
    ends = true;
    closing.join();
    running.get();
}

TEST_F(SharedContexts, emptyFencesAreComplete) {
    Fence().wait();
    EXPECT_TRUE(Fence().wait(0));
}

}  // namespace
}  // namespace defocus::engine
