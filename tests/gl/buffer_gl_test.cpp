#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/buffer_writer.h"
#include "gl/gl_test.h"
#include "gl/texel_buffer.h"
#include "gl_conduct.h"

namespace defocus::engine {
namespace {

using GlBuffer = GlTest;
using GlVertexArray = GlTest;
using GlTexelBuffer = GlTest;

std::vector<std::uint32_t> contentsOf(const Buffer& buffer) {
    std::vector<std::uint32_t> words(buffer.bytes() / 4);
    glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(buffer.bytes()), words.data());
    return words;
}

TEST_F(GlBuffer, holdsWhatItWasMadeOf) {
    std::vector<std::uint32_t> words(1000);
    std::iota(words.begin(), words.end(), 7u);
    const Buffer buffer = Buffer::of(std::span<const std::uint32_t>(words));
    EXPECT_EQ(buffer.bytes(), 4000u);
    EXPECT_EQ(contentsOf(buffer), words);
}

TEST_F(GlBuffer, updateChangesItsRangeAndNothingElse) {
    const std::vector<std::uint32_t> zeros(8, 0);
    Buffer buffer = Buffer::of(std::span<const std::uint32_t>(zeros));
    const std::array<std::uint32_t, 3> changed = {1, 2, 3};
    buffer.update(8, sizeof changed, changed.data());
    EXPECT_EQ(contentsOf(buffer), (std::vector<std::uint32_t>{0, 0, 1, 2, 3, 0, 0, 0}));
    buffer.update(0, 0, nullptr);
    EXPECT_EQ(contentsOf(buffer), (std::vector<std::uint32_t>{0, 0, 1, 2, 3, 0, 0, 0}));
}

TEST_F(GlBuffer, ofNoBytesIsStillABuffer) {
    const Buffer buffer(0);
    EXPECT_TRUE(buffer);
    EXPECT_EQ(buffer.bytes(), 0u);
    EXPECT_EQ(glIsBuffer(buffer.name()), GL_TRUE);
    EXPECT_FALSE(Buffer());
}

TEST_F(GlBuffer, livesAsLongAsItsLastOwner) {
    GLuint name = 0;
    {
        Buffer first(4);
        name = first.name();
        Buffer second = std::move(first);
        EXPECT_EQ(second.name(), name);
        EXPECT_EQ(glIsBuffer(name), GL_TRUE);
    }
    EXPECT_EQ(glIsBuffer(name), GL_FALSE);
}

TEST_F(GlBuffer, beyondMemoryIsAnErrorThatSaysHowMuch) {
    const ExpectedGlMessages wrongOnPurpose;
    constexpr std::size_t bytes = std::size_t{1} << 60;
    try {
        const Buffer buffer(bytes);
        FAIL() << "no machine has this memory";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(bytes)), std::string::npos) << error.what();
    }
}

// Vertex shader that draws each vertex as one pixel, in column `place`.x of the row whose number is the instance index.
constexpr const char* pixelOfVertex = R"(
layout(location = 2) in vec2 place;
layout(location = 5) in float shade;
layout(location = 6) in float once;
flat out vec4 handed;
void main() {
    gl_Position = vec4((2.0 * place.x + 1.0) / 4.0 - 1.0, (2.0 * float(gl_InstanceID) + 1.0) / 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = 1.0;
    handed = vec4(shade, once, place.y, 1.0);
}
)";

// A buffer can be written in parts that are smaller or larger than the writer's staging memory.
TEST_F(GlBuffer, isWrittenInPartsOfAnySize) {
    std::vector<std::uint32_t> words(400'000);
    std::iota(words.begin(), words.end(), 7u);
    BufferWriter writer(words.size() * 4);
    std::size_t at = 0;
    for (const int part : {1, 3, 60'000, 0, 10'000, 200'000, 5, 129'991}) {
        writer.append(std::span<const std::uint32_t>(words).subspan(at, static_cast<std::size_t>(part)));
        at += static_cast<std::size_t>(part);
    }
    ASSERT_EQ(at, words.size());
    EXPECT_EQ(contentsOf(writer.finish()), words);
}

TEST_F(GlVertexArray, readsAttributesByOffsetStrideTypeAndInstance) {
    struct Vertex {
        float unused;
        float place[2];
    };
    const std::array<Vertex, 4> vertices = {{{-9, {0, 10}}, {-9, {1, 11}}, {-9, {2, 12}}, {-9, {3, 13}}}};
    const std::array<std::uint8_t, 4> shades = {0, 51, 102, 255};
    const std::array<float, 2> steps = {100, 200};  // one attribute value per instance
    const Buffer vertexBuffer = Buffer::of(std::span<const Vertex>(vertices));
    const Buffer shadeBuffer = Buffer::of(std::span<const std::uint8_t>(shades));
    const Buffer stepBuffer = Buffer::of(std::span<const float>(steps));
    VertexArray array;
    array.attribute(2, 2, GL_FLOAT, false);
    array.bind(2, vertexBuffer, sizeof(float), sizeof(Vertex));
    array.attribute(5, 1, GL_UNSIGNED_BYTE, true);
    array.bind(5, shadeBuffer, 0, 1);
    array.attribute(6, 1, GL_FLOAT, false, true);
    array.bind(6, stepBuffer, 0, sizeof(float));
    const std::array<std::uint16_t, 3> used = {3, 1, 0};  // indices that do not refer to vertex 2
    const Buffer indexBuffer = Buffer::of(std::span<const std::uint16_t>(used));
    array.indices(indexBuffer);

    writeShader("points.vert", pixelOfVertex);
    writeShader("points.frag", "flat in vec4 handed;\nout vec4 value;\nvoid main() { value = handed; }\n");
    const Program points = program({"points.vert", "points.frag"});
    const GlTexture texture({.format = TextureFormat::rgba32f, .width = 4, .height = 2});
    const Target target({&texture});
    target.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    points.use();
    array.use();
    glDrawElementsInstanced(GL_POINTS, 3, GL_UNSIGNED_SHORT, nullptr, 2);
    const Image image = readBack(texture, 4);
    for (int instance = 0; instance < 2; ++instance)
        for (int x = 0; x < 4; ++x) {
            const float* pixel = image.at(x, 1 - instance);
            const bool drawn = x != 2;
            EXPECT_EQ(pixel[3], drawn ? 1 : 0) << x;
            if (!drawn) continue;
            EXPECT_NEAR(pixel[0], shades[static_cast<std::size_t>(x)] / 255.0, 1e-6);
            EXPECT_EQ(pixel[1], steps[static_cast<std::size_t>(instance)]);
            EXPECT_EQ(pixel[2], 10 + x);
        }
}

TEST_F(GlTexelBuffer, isReadTexelByTexel) {
    std::vector<float> values(3 * 16);
    std::iota(values.begin(), values.end(), 0.5f);
    const TexelBuffer buffer(values, GL_RGB32F, 3, "test values");
    EXPECT_EQ(buffer.bytes(), values.size() * sizeof(float));
    const Program read = fragmentProgram("layout(binding = 3) uniform samplerBuffer texels;",
                                         "value = texelFetch(texels, int(gl_FragCoord.x));");
    buffer.attach(3);
    const Image image = computed(read, 16, 1);
    for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(x, 0)[c], values[static_cast<std::size_t>(3 * x + c)]);
}

TEST_F(GlTexelBuffer, beyondTheDriversLimitNamesWhatItHolds) {
    GLint max = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &max);
    const std::size_t count = static_cast<std::size_t>(max) + 1;
    // Deleter for memory from calloc(), which takes no physical memory until it is accessed.
    struct Freed {
        void operator()(void* memory) const { std::free(memory); }
    };
    const std::unique_ptr<void, Freed> pages(std::calloc(count, sizeof(float)));
    ASSERT_NE(pages, nullptr);
    try {
        const TexelBuffer buffer({static_cast<const float*>(pages.get()), count}, GL_R32F, 1, "test values");
        FAIL() << "one texel too many";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("test values"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(std::to_string(count)), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace defocus::engine
