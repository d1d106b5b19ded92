#include <array>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/target.h"
#include "gl_conduct.h"

namespace defocus::engine {
namespace {

using GlTarget = GlTest;

GlTexture textureOf(TextureFormat format, int layers = 0) {
    return GlTexture({.format = format, .width = 6, .height = 4, .layers = layers});
}

std::string faultOf(const std::vector<const GlTexture*>& colors, const GlTexture* depth = nullptr) {
    try {
        const Target target(colors, depth);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST_F(GlTarget, bindMakesItsWholeAreaTheViewport) {
    const GlTexture texture = textureOf(TextureFormat::rgba32f);
    const Target target({&texture});
    glViewport(1, 1, 1, 1);
    target.bind();
    Fullscreen().draw(fragmentProgram("", "value = vec4(gl_FragCoord.xy, 0, 1);"));
    const Image image = readBack(texture, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            EXPECT_EQ(image.at(x, y)[0], static_cast<float>(x) + 0.5f);
            EXPECT_EQ(image.at(x, y)[1], 4 - (static_cast<float>(y) + 0.5f));
        }
}

TEST_F(GlTarget, coloursAreAttachedInOrder) {
    const GlTexture first = textureOf(TextureFormat::rgba32f), second = textureOf(TextureFormat::r32f),
                    third = textureOf(TextureFormat::rgba16f);
    const Target target({&first, &second, &third});
    target.bind();
    writeShader(
        "three.frag",
        "layout(location = 0) out vec4 a;\nlayout(location = 1) out float b;\nlayout(location = 2) out vec4 c;\n"
        "void main() { a = vec4(1); b = 2.0; c = vec4(3); }\n");
    Fullscreen().draw(program({fullscreenShader, "three.frag"}));
    EXPECT_EQ(*readBack(first, 4).at(5, 3), 1);
    EXPECT_EQ(*readBack(second, 1).at(5, 3), 2);
    EXPECT_EQ(*readBack(third, 4).at(5, 3), 3);
}

TEST_F(GlTarget, depthIsKeptForWhatIsDrawnLater) {
    const GlTexture color = textureOf(TextureFormat::rgba32f), depth = textureOf(TextureFormat::depth32f);
    const Target target({&color}, &depth);
    target.bind();
    const float half = 0.5f, zero[4] = {0, 0, 0, 0};
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &half);
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, zero);
    EXPECT_EQ(*readBack(color, 4).at(0, 0), 0);
    std::array<float, 24> depths{};
    glGetTextureImage(depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depths, depths.data());
    for (const float value : depths) EXPECT_EQ(value, 0.5f);
}

// If all layers of an array texture are attached, gl_Layer in the shader selects the layer that is drawn.
TEST_F(GlTarget, layersArePickedByTheShader) {
    const GlTexture array = textureOf(TextureFormat::rgba32f, 3);
    const Target target({&array});
    target.bind();
    const float zero[4] = {0, 0, 0, 0};
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, zero);
    writeShader("layer.geom",
                "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\nvoid main() {\n"
                "for (int i = 0; i < 3; ++i) { gl_Layer = 2; gl_Position = gl_in[i].gl_Position; EmitVertex(); }\n}\n");
    writeShader("seven.frag", "out vec4 value;\nvoid main() { value = vec4(7); }\n");
    Fullscreen().draw(program({fullscreenShader, "layer.geom", "seven.frag"}));
    for (int layer = 0; layer < 3; ++layer) {
        std::array<float, 4> pixel{};
        glGetTextureSubImage(array.name(), 0, 3, 2, layer, 1, 1, 1, GL_RGBA, GL_FLOAT, sizeof pixel, pixel.data());
        EXPECT_EQ(pixel[0], layer == 2 ? 7 : 0) << layer;
    }
}

TEST_F(GlTarget, whatCannotBeRenderedToIsSaidInWords) {
    const ExpectedGlMessages wrongOnPurpose;
    EXPECT_NE(faultOf({}).find("no attachment"), std::string::npos) << faultOf({});
    const GlTexture flat = textureOf(TextureFormat::rgba32f), layered = textureOf(TextureFormat::rgba32f, 3),
                    depth = textureOf(TextureFormat::depth32f);
    EXPECT_NE(faultOf({&flat, &layered}).find("some attachments are layered and others are not"), std::string::npos)
        << faultOf({&flat, &layered});
    EXPECT_NE(faultOf({&depth}).find("6 x 4 px: an attachment is not renderable"), std::string::npos)
        << faultOf({&depth});
    EXPECT_EQ(faultOf({&flat}, &depth), "none");
}

}  // namespace
}  // namespace defocus::engine
