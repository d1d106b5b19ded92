#include "render/aov.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gl/read_back.h"
#include "gl/target.h"
#include "image/colour_map.h"
#include "render/pinhole_pass.h"

namespace defocus {

namespace {

GlTexture floatTexture(const View& view, TextureFormat format) {
    return GlTexture({.format = format, .width = view.width, .height = view.height});
}

}  // namespace

AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder) {
    const FramePlan pinhole = pinholePlan(world, plan, 1);
    const GlTexture depth = floatTexture(plan.view, TextureFormat::r32f);
    const GlTexture coc = floatTexture(plan.view, TextureFormat::r32f);
    const GlTexture level = floatTexture(plan.view, TextureFormat::r32f);
    const GlTexture depthBuffer = floatTexture(plan.view, TextureFormat::depth32f);
    const Target target({&depth, &coc, &level}, &depthBuffer);

    // Clear to what lies behind everything.
    target.bind();
    glDepthMask(GL_TRUE);
    const float behind[3] = {
        std::numeric_limits<float>::infinity(),
        static_cast<float>(circleOfConfusion(plan.coc, std::numeric_limits<double>::infinity(), plan.view.width)), -1};
    for (GLint i = 0; i < 3; ++i) {
        const float value[4] = {behind[i], 0, 0, 0};
        glClearNamedFramebufferfv(target.name(), GL_COLOR, i, value);
    }
    constexpr float farthest = 0;
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);

    GpuScene scene(world);
    scene.prepare(pinhole);
    SurfacePass surfaces(scene, {.fragmentShader = "aov/aov.frag",
                                 .defines = {{"READS_COC_SCALE", "1"},
                                             {"IMAGE_SIZE", fmt::format("{}, {}", plan.view.width, plan.view.height)}},
                                 .shaded = false,
                                 .shaderFolder = shaderFolder});
    FrameUniforms frame;
    frame.upload(world, pinhole, 1);
    surfaces.prepare(pinhole, frame);
    surfaces.drawSurfaces(0, 1);
    return {readBack(depth, 1), readBack(coc, 1), readBack(level, 1)};
}

Image levelColourMap(const Image& level) {
    constexpr float coarsest = 8;
    Image colours(level.width, level.height, 3);
    for (std::size_t i = 0; i < level.pixels.size(); ++i) {
        const float value = level.pixels[i];
        const glm::vec3 colour = value < 0 ? glm::vec3(0) : viridis(std::min(value / coarsest, 1.0f));
        for (glm::length_t c = 0; c < 3; ++c) colours.pixels[i * 3 + static_cast<std::size_t>(c)] = colour[c];
    }
    return colours;
}

}  // namespace defocus
