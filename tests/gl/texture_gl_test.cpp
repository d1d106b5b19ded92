#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/texture.h"
#include "gl_conduct.h"

namespace defocus::engine {
namespace {

using GlTextureTest = GlTest;

// Returns the linear value of an 8-bit sRGB value (IEC 61966-2-1).
double linearOf(double code) {
    const double encoded = code / 255;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::vector<std::uint8_t> allCodes() {
    std::vector<std::uint8_t> bytes;
    for (int code = 0; code < 256; ++code)
        for (const int channel : {code, 255 - code, code / 2, code})
            bytes.push_back(static_cast<std::uint8_t>(channel));
    return bytes;
}

TEST_F(GlTextureTest, bytesAreSharesOf255) {
    GlTexture texture({.format = TextureFormat::rgba8, .width = 256, .height = 1});
    const std::vector<std::uint8_t> bytes = allCodes();
    texture.upload(0, 256, 1, bytes.data());
    const Image image = fetched(texture);
    for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_NEAR(image.pixels[i], bytes[i] / 255.0, 1e-6) << i;
}

// sRGB textures decode colours but not alpha. The tolerance is half a step between 8-bit values, since drivers
// approximate the decoding by polynomials.
TEST_F(GlTextureTest, sRgbCodesAreDecodedAndAlphaIsNot) {
    GlTexture texture({.format = TextureFormat::srgb8Alpha8, .width = 256, .height = 1});
    const std::vector<std::uint8_t> bytes = allCodes();
    texture.upload(0, 256, 1, bytes.data());
    const Image image = fetched(texture);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i % 4 == 3) {
            ASSERT_NEAR(image.pixels[i], bytes[i] / 255.0, 1e-6) << i;
        } else {
            const double step = linearOf(std::max<int>(bytes[i], 1)) - linearOf(std::max<int>(bytes[i], 1) - 1);
            ASSERT_NEAR(image.pixels[i], linearOf(bytes[i]), 0.5 * step) << i;
        }
    }
}

TEST_F(GlTextureTest, floatsKeepTheirValueAndHalvesTenBits) {
    const std::array<float, 8> values = {0, 1.0f / 3, -2.7182818f, 65504, 1e-3f, 100.001f, -0.1f, 1};
    for (const TextureFormat format : {TextureFormat::rgba32f, TextureFormat::rgba16f}) {
        GlTexture texture({.format = format, .width = 2, .height = 1});
        texture.upload(0, 2, 1, values.data());
        const Image image = fetched(texture);
        for (std::size_t i = 0; i < values.size(); ++i) {
            // some drivers truncate instead of rounding when they convert to half floats
            const double relative = format == TextureFormat::rgba32f ? 0 : 0x1p-10;
            EXPECT_NEAR(image.pixels[i], values[i], relative * std::abs(values[i])) << i;
        }
    }
}

TEST_F(GlTextureTest, integersKeepEachBit) {
    const std::array<std::uint32_t, 3> values = {0xDEADBEEFu, 0xFFFFFFFFu, 1u};
    GlTexture texture({.format = TextureFormat::r32ui, .width = 3, .height = 1});
    texture.upload(0, 3, 1, values.data());
    const Program split = fragmentProgram("layout(binding = 0) uniform usampler2D source;",
                                          "uint bits = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r;\n"
                                          "value = vec4(bits >> 16, bits & 0xFFFFu, 0, 0);");
    texture.attach(0);
    const Image image = computed(split, 3, 1);
    for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(image.at(x, 0)[0], values[static_cast<std::size_t>(x)] >> 16);
        EXPECT_EQ(image.at(x, 0)[1], values[static_cast<std::size_t>(x)] & 0xFFFFu);
    }
}

TEST_F(GlTextureTest, rowsFollowEachOtherFromTheBottom) {
    GlTexture texture({.format = TextureFormat::r32f, .width = 3, .height = 3});
    const std::array<float, 9> values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    texture.upload(0, 3, 3, values.data());
    const Image image = readBack(texture, 1);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(*image.at(x, 2 - y), values[static_cast<std::size_t>(3 * y + x)]);
}

// Each texel of a mip level is the mean of four texels of the previous level. The last level is the mean of all texels.
TEST_F(GlTextureTest, mipmapsAreMeans) {
    constexpr int size = 8;
    GlTexture texture(
        {.format = TextureFormat::rgba32f, .width = size, .height = size, .levels = mipmapLevels(size, size)});
    std::vector<float> values;
    double sum = 0;
    for (int i = 0; i < size * size; ++i) {
        const auto value = static_cast<float>((i * 37) % 64);
        sum += static_cast<double>(value);
        values.insert(values.end(), {value, 1 - value, 0, 1});
    }
    texture.upload(0, size, size, values.data());
    texture.generateMipmaps();
    const Image first = fetched(texture, 1);
    for (int y = 0; y < size / 2; ++y)
        for (int x = 0; x < size / 2; ++x) {
            const int row = size / 2 - 1 - y;  // texture rows start at the bottom, image rows at the top
            double mean = 0;
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
                mean += 0.25 *
                        static_cast<double>(values[static_cast<std::size_t>(4 * ((2 * row + dy) * size + 2 * x + dx))]);
            ASSERT_NEAR(first.at(x, y)[0], mean, 1e-4);
        }
    const Image last = fetched(texture, mipmapLevels(size, size) - 1);
    EXPECT_NEAR(last.at(0, 0)[0], sum / (size * size), 1e-4);
}

// Wrap modes map coordinates outside [0, 1] back into a texture, here of a red and a green texel.
TEST_F(GlTextureTest, wrapModesFoldTheCoordinates) {
    GlTexture texture({.format = TextureFormat::rgba32f, .width = 2, .height = 1});
    const std::array<float, 8> values = {1, 0, 0, 1, 0, 1, 0, 1};
    texture.upload(0, 2, 1, values.data());
    const Program sample = fragmentProgram("layout(binding = 0) uniform sampler2D source;",
                                           "value = texture(source, vec2(gl_FragCoord.x * 0.5 - 1.0, 0.5));");
    // Returns the colours of the samples at u = −0.75, −0.25, 0.25, 0.75, 1.25 and 1.75 as the letters r and g.
    const auto letters = [&](GLenum wrap) {
        texture.sampling(GL_NEAREST, GL_NEAREST, wrap, GL_CLAMP_TO_EDGE);
        texture.attach(0);
        const Image image = computed(sample, 6, 1);
        std::string text;
        for (int x = 0; x < 6; ++x) text += image.at(x, 0)[0] > 0.5f ? 'r' : 'g';
        return text;
    };
    EXPECT_EQ(letters(GL_REPEAT), "rgrgrg");
    EXPECT_EQ(letters(GL_CLAMP_TO_EDGE), "rrrggg");
    EXPECT_EQ(letters(GL_MIRRORED_REPEAT), "grrggr");
}

TEST_F(GlTextureTest, bytesAreThoseOfAllLevelsAndLayers) {
    EXPECT_EQ(GlTexture().bytes(), 0u);
    EXPECT_EQ(GlTexture({.format = TextureFormat::rgba16f, .width = 5, .height = 3}).bytes(), 5u * 3 * 8);
    EXPECT_EQ(GlTexture({.format = TextureFormat::rgba8, .width = 8, .height = 2, .levels = 4}).bytes(),
              4u * (16 + 4 + 2 + 1));
    EXPECT_EQ(GlTexture({.format = TextureFormat::rgba8, .width = 2, .height = 8, .levels = 4}).bytes(),
              4u * (16 + 4 + 2 + 1));
    EXPECT_EQ(GlTexture({.format = TextureFormat::depth32f, .width = 4, .height = 4, .layers = 6}).bytes(),
              4u * 16 * 6);
}

TEST_F(GlTextureTest, aFullChainHalvesTheLongerSideToOne) {
    EXPECT_EQ(mipmapLevels(1, 1), 1);
    EXPECT_EQ(mipmapLevels(2, 1), 2);
    EXPECT_EQ(mipmapLevels(5, 3), 3);
    EXPECT_EQ(mipmapLevels(1024, 768), 11);
    EXPECT_EQ(mipmapLevels(1, 1025), 11);
}

TEST_F(GlTextureTest, beyondTheDriversLimitNamesTheSize) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    for (const auto& [width, height] : {std::pair{limit + 1, 1}, {1, limit + 1}}) {
        try {
            const GlTexture texture({.width = width, .height = height});
            FAIL() << "one pixel too many";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(std::to_string(limit + 1)), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(std::to_string(limit) + " px"), std::string::npos) << error.what();
        }
    }
}

TEST_F(GlTextureTest, beyondTheDriversLayersNamesTheirNumber) {
    GLint max = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max);
    EXPECT_NO_THROW(GlTexture({.width = 1, .height = 1, .layers = max}));
    try {
        const GlTexture texture({.width = 1, .height = 1, .layers = max + 1});
        FAIL() << "one layer too many";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(max + 1) + " layers"), std::string::npos)
            << error.what();
    }
}

TEST_F(GlTextureTest, beyondMemoryIsAnError) {
    if (!currentIsSoftware()) GTEST_SKIP() << "a GPU's driver may allocate the memory at the first draw";
    const ExpectedGlMessages wrongOnPurpose;
    GLint limit = 0, layers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    EXPECT_THROW(GlTexture({.width = limit, .height = limit, .layers = layers}), Error);  // a texture of at least 2 TB
    while (glGetError() != GL_NO_ERROR) {
    }
}

}  // namespace
}  // namespace defocus::engine
