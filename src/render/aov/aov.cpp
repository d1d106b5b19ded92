#include "render/aov/aov.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gl/read_back.h"
#include "image/colour_map.h"
#include "render/gpu_scene/colour_texture.h"
#include "render/post_process/pinhole_pass.h"

namespace defocus::engine {

AovPass::AovPass(const World& world, std::filesystem::path shaderFolder)
    : shaderFolder_(std::move(shaderFolder)),
      scene_(world),
      surfaces_(scene_, scene_.pacer(),
                {.fragmentShader = "aov/aov.frag",
                 .defines = {},
                 .look = SurfaceLook::flat,
                 .readsOwnBlur = true,
                 .shaderFolder = shaderFolder_}),
      edges_(scene_, scene_.pacer(),
             {.fragmentShader = "aov/wireframe.frag",
              .defines = {},
              .look = SurfaceLook::flat,
              .shaderFolder = shaderFolder_}) {}

void AovPass::makeTargets(int width, int height) {
    if (depth_ && depth_.info().width == width && depth_.info().height == height) return;
    const auto texture = [&](TextureFormat format) {
        return GlTexture({.format = format, .width = width, .height = height});
    };
    depth_ = texture(TextureFormat::r32f);
    coc_ = texture(TextureFormat::r32f);
    level_ = texture(TextureFormat::r32f);
    depthBuffer_ = texture(TextureFormat::depth32f);
    target_ = Target({&depth_, &coc_, &level_}, &depthBuffer_);
    wireframe_ = GlTexture();
}

void AovPass::draw(const FramePlan& plan) {
    pinhole_ = pinholePlan(scene_.world(), plan, 1);
    makeTargets(plan.view.width, plan.view.height);

    // Clear to the values of a point at infinity.
    target_.bind();
    glDepthMask(GL_TRUE);
    const float behind[3] = {
        std::numeric_limits<float>::infinity(),
        static_cast<float>(circleOfConfusion(plan.coc, std::numeric_limits<double>::infinity(), plan.view.width)), -1};
    for (GLint i = 0; i < 3; ++i) {
        const float value[4] = {behind[i], 0, 0, 0};
        glClearNamedFramebufferfv(target_.name(), GL_COLOR, i, value);
    }
    constexpr float farthest = 0;
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);

    scene_.prepare(pinhole_);
    frame_.upload(scene_.world(), pinhole_, 1);
    surfaces_.prepare(pinhole_, frame_);
    surfaces_.drawSurfaces(0, 1);
}

void AovPass::drawWireframe() {
    if (!wireframe_) {
        const TextureInfo& info = depth_.info();
        wireframe_ =
            GlTexture({.format = TextureFormat::rgba8, .width = info.width, .height = info.height, .linear = true});
        wireTarget_ = Target({&wireframe_}, &depthBuffer_);
    }
    if (!levelColours_) levelColours_ = colourMapTexture(viridis);
    wireTarget_.bind();
    constexpr float nothing[4] = {};
    glClearNamedFramebufferfv(wireTarget_.name(), GL_COLOR, 0, nothing);
    edges_.prepare(pinhole_, frame_);
    constexpr GLuint coloursUnit = 32;  // texture unit in shaders/aov/wireframe.frag
    levelColours_.attach(coloursUnit);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glEnable(GL_POLYGON_OFFSET_LINE);
    glPolygonOffset(1, 8);  // depth is reversed: positive offsets are towards the camera
    edges_.drawSurfaces(0, 1);
    glDisable(GL_POLYGON_OFFSET_LINE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder) {
    AovPass pass(world, shaderFolder);
    pass.draw(plan);
    return {readBack(pass.depth(), 1), readBack(pass.coc(), 1), readBack(pass.level(), 1)};
}

Image levelColourMap(const Image& level) {
    Image colours(level.width, level.height, 3);
    for (std::size_t i = 0; i < level.pixels.size(); ++i) {
        const float value = level.pixels[i];
        const glm::vec3 colour = value < 0 ? glm::vec3(0) : viridis(std::clamp(value / coarsestShownLevel, 0.0f, 1.0f));
        for (glm::length_t c = 0; c < 3; ++c) colours.pixels[i * 3 + static_cast<std::size_t>(c)] = colour[c];
    }
    return colours;
}

}  // namespace defocus::engine
