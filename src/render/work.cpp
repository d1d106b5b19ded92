#include "render/work.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gl/read_back.h"
#include "gl/target.h"
#include "image/colour_map.h"
#include "render/surface_pass.h"

namespace defocus {

Image renderWork(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder) {
    const GlTexture work({.format = TextureFormat::r32f, .width = plan.view.width, .height = plan.view.height});
    const Target target({&work});
    constexpr float nothing[4] = {};
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, nothing);

    GpuScene scene(world);
    FrameUniforms frame;
    SurfacePass surfaces(scene, {.fragmentShader = "aov/work.frag",
                                 .defines = {},
                                 .shaded = false,
                                 .vertexShaderLayers = vertexShaderMayPickLayer(),
                                 .shaderFolder = shaderFolder});
    scene.prepare(plan);
    frame.upload(world, plan, 1);
    surfaces.prepare(plan, frame);
    target.bind();
    surfaces.drawTouched(0, static_cast<std::uint32_t>(plan.samples.size()));
    return readBack(work, 1);
}

Image workColourMap(const Image& work, std::uint32_t samples) {
    Image shares = work;
    for (float& value : shares.pixels)
        value = std::log2(1 + value / static_cast<float>(samples)) / std::log2(1 + mostShownWork);
    return colourMapped(shares);
}

WorkSummary workSummary(const Image& work, std::uint32_t samples) {
    const double sum = std::accumulate(work.pixels.begin(), work.pixels.end(), 0.0);
    const float most = *std::max_element(work.pixels.begin(), work.pixels.end());
    return {sum / (static_cast<double>(work.pixels.size()) * samples), static_cast<double>(most) / samples};
}

}  // namespace defocus
