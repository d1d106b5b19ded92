// Hammersley 1960, Monte Carlo Methods for Solving Multivariable Problems (the points in the pixel).

#include "render/post_process/pinhole_pass.h"

#include <algorithm>
#include <cmath>

namespace defocus {

namespace {

constexpr std::uint32_t lightPoints = 16;  // of a pinhole's shadows, on each light

GlTexture texture(int width, int height, TextureFormat format) {
    return GlTexture({.format = format, .width = width, .height = height});
}

ShaderDefines definesOf(LayerFormat format) {
    ShaderDefines defines = layerFormatDefines(format);
    defines.emplace_back("READS_OWN_BLUR", "1");
    return defines;
}

// Of every surface but the sky and what is translucent: those leave it as it is.
void writeOwnBlur(bool on) {
    const GLboolean mask = on ? GL_TRUE : GL_FALSE;
    glColorMaski(1, mask, mask, mask, mask);
}

}  // namespace

FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count) {
    FramePlan pinholes = plan;
    pinholes.samples.assign(count, LensSample{});
    for (std::uint32_t i = 0; i < count && count > 1; ++i)
        pinholes.samples[i].pixel = glm::vec2((i + 0.5) / count - 0.5, radicalInverse(2, i) + 0.5 / count - 0.5);
    pinholes.coc.chromatic = 0;
    pinholes.coc.astigmatism = 0;
    pinholes.coc.coma = 0;
    pinholes.usesCocControls = plan.usesLens && (plan.usesOwnBlur || !pinholes.coc.thinLens());
    pinholes.view.lens.catEye = 0;
    pinholes.trianglesDrawn = 0;
    pinholes.moments.clear();
    pinholes.shadows.points = lightPoints;
    for (std::uint32_t i = 0; i < count; ++i) pinholes.samples[i].index = i;
    for (ObjectPlan& object : pinholes.objects) {
        object.motion.clear();
        const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
        const auto last = static_cast<double>(pyramid.levels.size() - 1);
        const auto level = static_cast<std::uint32_t>(std::min(std::round(object.lambda), last));
        object.coarse = {};
        object.fine = {level, 0, count, pyramid.levels[level].triangleCount};
        pinholes.levelsUsed[static_cast<std::size_t>(object.mesh)][level] = true;
        pinholes.trianglesDrawn += std::uint64_t{object.fine.triangleCount} * count;
    }
    return pinholes;
}

PinholePass::PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur,
                         const std::filesystem::path& shaderFolder)
    : color_(texture(width, height, layerTextureFormat(format))),
      depth_(texture(width, height, TextureFormat::depth32f)),
      ownBlur_(ownBlur ? texture(width, height, TextureFormat::rg32f) : GlTexture()),
      target_(ownBlur ? Target({&color_, &ownBlur_}, &depth_) : Target({&color_}, &depth_)),
      shadows_(scene, vertexShaderMayPickLayer(), shaderFolder),
      surfaces_(scene, {.fragmentShader = "accumulation/object.frag",
                        .defines = definesOf(format),
                        .vertexShaderLayers = vertexShaderMayPickLayer(),
                        .shaderFolder = shaderFolder}) {
    color_.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
}

void PinholePass::attachForBlur() const {
    depth_.attach(1);
    if (ownBlur_) ownBlur_.attach(6);
}

void PinholePass::readAsCoverage(bool on) {
    constexpr GLint radiance[4] = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
    constexpr GLint coverage[4] = {GL_ALPHA, GL_ALPHA, GL_ALPHA, GL_ALPHA};
    glTextureParameteriv(color_.name(), GL_TEXTURE_SWIZZLE_RGBA, on ? coverage : radiance);
}

void PinholePass::prepare(const FramePlan& pinholes, const FrameUniforms& frame) {
    transparent_ = pinholes.needsAlpha;
    shadows_.prepare(pinholes, frame);
    surfaces_.prepare(pinholes, frame, &shadows_);
}

void PinholePass::draw(std::uint32_t index) {
    shadows_.draw(index, 1);
    target_.bind();
    glDepthMask(GL_TRUE);
    constexpr float farthest = 0;  // reversed depth
    const float nothing[4] = {0, 0, 0, transparent_ ? 0.0f : 1.0f};
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, nothing);
    constexpr float none[4] = {1, 0, 0, 1};
    if (ownBlur_) glClearNamedFramebufferfv(target_.name(), GL_COLOR, 1, none);
    surfaces_.drawOpaque(index, 1);
    if (ownBlur_) writeOwnBlur(false);
    if (!transparent_) surfaces_.drawSky(index, 1);
    surfaces_.drawTranslucent(index, 1, color_);
    if (ownBlur_) writeOwnBlur(true);
    surfaces_.drawTranslucentDepth(index, 1);
}

}  // namespace defocus
