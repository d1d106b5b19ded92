#include "render/post_process/bucket_pass.h"

namespace defocus::engine {

BucketPass::BucketPass(const PinholeImage& opaque, LayerFormat format, const std::filesystem::path& shaderFolder)
    : opaque_(&opaque) {
    const int width = opaque.color.info().width;
    const int height = opaque.color.info().height;
    const bool ownBlur = static_cast<bool>(opaque.ownBlur);
    image_ = PinholeImage(width, height, format, TextureFormat::r32f, ownBlur);
    surfaceDepth_ = GlTexture({.format = TextureFormat::depth32f, .width = width, .height = height});
    known_ = GlTexture(
        {.format = TextureFormat::rgba32f, .width = width, .height = height, .levels = mipmapLevels(width, height)});
    known_.sampling(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);

    std::vector<const GlTexture*> surfaceColors = {&image_.color};
    std::vector<const GlTexture*> blurs = {&image_.depth};
    if (ownBlur) {
        surfaceOwnBlur_ = GlTexture({.format = TextureFormat::rg32f, .width = width, .height = height});
        surfaceColors.push_back(&surfaceOwnBlur_);
        blurs.push_back(&image_.ownBlur);
    }
    colorTarget_ = Target({&image_.color}, &opaque.depth);
    surfaceTarget_ = Target(surfaceColors, &surfaceDepth_);
    knownTarget_ = Target({&known_});
    imageTarget_ = Target(blurs);

    const ShaderDefines defines = ownBlur ? ShaderDefines{{"usesOwnBlur", "true"}} : ShaderDefines{};
    know_ = Program({{fullscreenShader, "post_process/bucket_surfaces.frag"}, defines, shaderFolder});
    fill_ = Program({{fullscreenShader, "post_process/bucket_blur.frag"}, defines, shaderFolder});
}

void BucketPass::draw(SurfacePass& surfaces, std::uint32_t sample, const ObjectSet& bucket) {
    constexpr float nothing[4] = {};
    constexpr float farthest = 0;  // depth is reversed
    colorTarget_.bind();
    glClearNamedFramebufferfv(colorTarget_.name(), GL_COLOR, 0, nothing);
    surfaces.drawTranslucent(sample, 1, image_.color, bucket);
    surfaceTarget_.bind();
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(surfaceTarget_.name(), GL_DEPTH, 0, &farthest);
    surfaces.drawTranslucentDepth(sample, 1, bucket);

    knownTarget_.bind();
    surfaceDepth_.attach(0);
    if (surfaceOwnBlur_) surfaceOwnBlur_.attach(1);
    fullscreen_.draw(know_);
    known_.generateMipmaps();
    imageTarget_.bind();
    known_.attach(0);
    opaque_->depth.attach(1);
    if (opaque_->ownBlur) opaque_->ownBlur.attach(2);
    fullscreen_.draw(fill_);
}

}  // namespace defocus::engine
