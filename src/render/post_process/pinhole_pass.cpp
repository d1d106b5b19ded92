// Source of the subpixel offsets: Hammersley 1960, Monte Carlo Methods for Solving Multivariable Problems.

#include "render/post_process/pinhole_pass.h"

#include <algorithm>
#include <cmath>

namespace defocus::engine {

namespace {

constexpr std::uint32_t lightPoints = 16;  // points on each light for soft shadows in a pinhole image

// Enables or disables writing the surfaces' blur modifiers. The sky and translucent surfaces must not change them.
void writeOwnBlur(bool on) {
    const GLboolean mask = on ? GL_TRUE : GL_FALSE;
    glColorMaski(1, mask, mask, mask, mask);
}

Target targetOf(const PinholeImage& image) {
    return image.ownBlur ? Target({&image.color, &image.ownBlur}, &image.depth) : Target({&image.color}, &image.depth);
}

}  // namespace

FramePlan pinholePlan(const World& world, const FramePlan& plan, std::uint32_t count) {
    FramePlan pinholes = plan;
    pinholes.samples.assign(count, LensSample{});
    pinholes.settings.firstSample = pinholes.frameFirst = 0;
    pinholes.frameSamples = count;
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

PinholePass::PinholePass(GpuScene& scene, int width, int height, LayerFormat format, bool ownBlur, int samples,
                         const std::filesystem::path& shaderFolder)
    : format_(format),
      shaderFolder_(shaderFolder),
      image_(width, height, format, TextureFormat::depth32f, ownBlur),
      target_(targetOf(image_)),
      shadows_(scene, scene.pacer(), vertexShaderMayPickLayer(), shaderFolder),
      surfaces_(scene, scene.pacer(),
                {.fragmentShader = "accumulation/object.frag",
                 .defines = layerFormatDefines(format),
                 .readsOwnBlur = true,
                 .vertexShaderLayers = vertexShaderMayPickLayer(),
                 .shaderFolder = shaderFolder}) {
    if (samples == 1) return;
    multisampled_ = PinholeImage(width, height, format, TextureFormat::depth32f, ownBlur, samples);
    image_.multisampled = &multisampled_;
    resolvedTarget_ = std::move(target_);
    target_ = targetOf(multisampled_);
}

void PinholePass::prepare(const FramePlan& pinholes, const FrameUniforms& frame,
                          const std::vector<TransparencyBucket>& buckets) {
    transparent_ = pinholes.needsAlpha;
    shadows_.prepare(pinholes, frame);
    surfaces_.prepare(pinholes, frame, &shadows_);
    const std::size_t objects = pinholes.objects.size();
    buckets_.assign(buckets.size(), ObjectSet(objects, false));
    inNoBucket_ = ObjectSet(objects, true);
    reaches_.clear();
    for (const TransparencyBucket& bucket : buckets) reaches_.push_back(reachOf(bucket, pinholes));
    for (std::size_t i = 0; i < buckets.size(); ++i)
        for (const std::size_t object : buckets[i]) {
            buckets_[i][object] = true;
            inNoBucket_[object] = false;
        }
    if (!buckets_.empty() && !bucketPass_) bucketPass_.emplace(image_, format_, shaderFolder_);
}

void PinholePass::draw(std::uint32_t index) {
    shadows_.draw(index, 1);
    target_.bind();
    glDepthMask(GL_TRUE);
    constexpr float farthest = 0;  // depth is reversed
    const float nothing[4] = {0, 0, 0, transparent_ ? 0.0f : 1.0f};
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, nothing);
    constexpr float none[4] = {1, 0, 0, 1};
    const bool ownBlur = hasOwnBlur();
    if (ownBlur) glClearNamedFramebufferfv(target_.name(), GL_COLOR, 1, none);
    surfaces_.drawOpaque(index, 1);
    if (ownBlur) writeOwnBlur(false);
    if (!transparent_) surfaces_.drawSky(index, 1);
    if (multisampled_.color) target_.resolve(resolvedTarget_, false);
    surfaces_.drawTranslucent(index, 1, image_.color, inNoBucket_);
    if (ownBlur) writeOwnBlur(true);
    surfaces_.drawTranslucentDepth(index, 1, inNoBucket_);
    if (multisampled_.color) target_.resolve(resolvedTarget_, true);
}

PinholeImage& PinholePass::drawBucket(std::uint32_t index, std::size_t bucket) {
    bucketPass_->draw(surfaces_, index, buckets_.at(bucket));
    bucketPass_->image().part = reaches_[bucket];
    return bucketPass_->image();
}

}  // namespace defocus::engine
