#include "gl/fullscreen.h"
#include "gl/gl_test.h"

namespace defocus::engine {
namespace {

using FullscreenPass = GlTest;

// A full-screen pass covers each pixel exactly once: with additive blending onto 0, every pixel has the drawn colour.
TEST_F(FullscreenPass, addsOnceToEachPixel) {
    const GlTexture texture({.format = TextureFormat::rgba32f, .width = 33, .height = 21});
    const Target target({&texture});
    target.bind();
    const float zero[4] = {0, 0, 0, 0};
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, zero);
    const Program one = fragmentProgram("", "value = vec4(1.0, 2.0, 3.0, 0.5);");
    const Fullscreen fullscreen;
    fullscreen.drawAdding(one);
    for (const float value : readBack(texture, 1).pixels) ASSERT_EQ(value, 1);
    fullscreen.drawAdding(one);
    const Image twice = readBack(texture, 4);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(twice.at(32, 20)[c], 2 * (c == 3 ? 0.5f : static_cast<float>(c + 1)));
    fullscreen.draw(one);  // without blending, the pass replaces the colour
    for (const float value : readBack(texture, 1).pixels) ASSERT_EQ(value, 1);
}

// A full-screen pass draws every pixel even if depth test, culling and blending are still enabled from earlier passes.
TEST_F(FullscreenPass, ignoresDepthCullingAndBlending) {
    const GlTexture color({.format = TextureFormat::rgba32f, .width = 4, .height = 4});
    const GlTexture depth({.format = TextureFormat::depth32f, .width = 4, .height = 4});
    const Target target({&color}, &depth);
    target.bind();
    const float nearest = 0, five[4] = {5, 5, 5, 5};
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &nearest);
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, five);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_NEVER);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT_AND_BACK);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    Fullscreen().draw(fragmentProgram("", "value = vec4(1.0);"));
    glDepthFunc(GL_LESS);
    glCullFace(GL_BACK);
    for (const float value : readBack(color, 4).pixels) EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace defocus::engine
