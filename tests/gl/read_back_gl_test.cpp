#include "gl/gl_test.h"
#include "gl/read_back.h"

namespace defocus::engine {
namespace {

using ReadBack = GlTest;

// The first row of an image is the top row, which is the last row in OpenGL.
TEST_F(ReadBack, rowZeroIsTheTop) {
    const Image image = computed(fragmentProgram("", "value = vec4(gl_FragCoord.xy, 2.0, 3.0);"), 5, 7);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 5; ++x) {
            EXPECT_EQ(image.at(x, y)[0], static_cast<float>(x) + 0.5f);
            EXPECT_EQ(image.at(x, y)[1], static_cast<float>(7 - y) - 0.5f);
            EXPECT_EQ(image.at(x, y)[2], 2);
            EXPECT_EQ(image.at(x, y)[3], 3);
        }
}

TEST_F(ReadBack, fewerChannelsAreTheFirstOnes) {
    const GlTexture texture({.format = TextureFormat::rgba32f, .width = 5, .height = 3});
    const Target target({&texture});
    target.bind();
    Fullscreen().draw(fragmentProgram("", "value = vec4(gl_FragCoord.x, gl_FragCoord.y, 9.0, 4.0);"));
    const Image all = readBack(texture, 4);
    for (const int channels : {1, 3}) {
        const Image some = readBack(texture, channels);
        ASSERT_EQ(some.channels, channels);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x)
                for (int c = 0; c < channels; ++c) EXPECT_EQ(some.at(x, y)[c], all.at(x, y)[c]);
    }
}

TEST_F(ReadBack, givesBackWhatWasUploadedWithItsTopAtTheTop) {
    Image image(3, 5, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i) * 0.25f - 3;
    GlTexture texture({.format = TextureFormat::rgba32f, .width = 3, .height = 5});
    upload(texture, image);
    EXPECT_EQ(readBack(texture, 4).pixels, image.pixels);
    float bottomLeft[4];
    glGetTextureSubImage(texture.name(), 0, 0, 0, 0, 1, 1, 1, GL_RGBA, GL_FLOAT, sizeof bottomLeft, bottomLeft);
    EXPECT_EQ(bottomLeft[0], *image.at(0, 4));
}

TEST_F(ReadBack, readsTheFirstLayer) {
    const GlTexture array({.format = TextureFormat::rgba32f, .width = 2, .height = 2, .layers = 2});
    for (int layer = 0; layer < 2; ++layer) {
        const auto value = static_cast<float>(layer + 1);
        const float pixel[4] = {value, value, value, value};
        glClearTexSubImage(array.name(), 0, 0, 0, layer, 2, 2, 1, GL_RGBA, GL_FLOAT, pixel);
    }
    EXPECT_EQ(readBack(array, 1).pixels, std::vector<float>(4, 1.0f));
}

}  // namespace
}  // namespace defocus::engine
