#include "render/aov/work.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/stopwatch.h"
#include "gl/read_back.h"
#include "image/colour_map.h"

namespace defocus::engine {

WorkPass::WorkPass(const World& world, std::filesystem::path shaderFolder)
    : scene_(world),
      surfaces_(scene_, scene_.pacer(),
                {.fragmentShader = "aov/work.frag",
                 .defines = {},
                 .look = SurfaceLook::flat,
                 .vertexShaderLayers = vertexShaderMayPickLayer(),
                 .shaderFolder = std::move(shaderFolder)}) {}

void WorkPass::begin(const FramePlan& plan) {
    const int width = plan.view.width;
    const int height = plan.view.height;
    if (!work_ || work_.info().width != width || work_.info().height != height) {
        work_ = GlTexture({.format = TextureFormat::r32f, .width = width, .height = height});
        work_.sampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
        target_ = Target({&work_});
    }
    constexpr float nothing[4] = {};
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, nothing);
    scene_.prepare(plan);
    frame_.upload(scene_.world(), plan, 1);
    surfaces_.prepare(plan, frame_);
    samples_ = 0;
    sampleTotal_ = static_cast<std::uint32_t>(plan.samples.size());
}

bool WorkPass::grow(double milliseconds) {
    constexpr std::uint32_t atOnce = 4;
    const Clock::time_point start = Clock::now();
    target_.bind();
    while (samples_ < sampleTotal_) {
        const Clock::time_point stepStart = Clock::now();
        const std::uint32_t count = std::min(atOnce, sampleTotal_ - samples_);
        surfaces_.drawTouched(samples_, count);
        samples_ += count;
        glFinish();
        if (millisecondsSince(start) + millisecondsSince(stepStart) > milliseconds) break;
    }
    return samples_ < sampleTotal_;
}

Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder) {
    WorkPass pass(world, shaderFolder);
    pass.begin(plan);
    pass.grow(std::numeric_limits<double>::infinity());
    return readBack(pass.work(), 1);
}

Image workColourMap(const Image& work, std::uint32_t samples) {
    Image shares = work;
    for (float& value : shares.pixels)
        value = std::log2(1 + value / static_cast<float>(samples)) / std::log2(1 + maxShownWork);
    return colourMapped(shares);
}

WorkSummary workSummary(const Image& work, std::uint32_t samples) {
    const double sum = std::accumulate(work.pixels.begin(), work.pixels.end(), 0.0);
    const float max = *std::max_element(work.pixels.begin(), work.pixels.end());
    return {sum / (static_cast<double>(work.pixels.size()) * samples), static_cast<double>(max) / samples};
}

}  // namespace defocus::engine
