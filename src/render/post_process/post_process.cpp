#include "render/post_process/post_process.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "gl/fullscreen.h"
#include "gl/scissor.h"
#include "render/accumulation/layer_sum.h"
#include "render/post_process/pinhole_pass.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

class PostProcessRenderer final : public Renderer {
public:
    PostProcessRenderer(const World& world, const RendererOptions& options, std::unique_ptr<PostProcess> process)
        : options_(options), process_(std::move(process)), scene_(world) {}

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        plan_ = pinholePlan(scene_.world(), plan, static_cast<std::uint32_t>(numberOf(options_.settings, "pinholes")));
        const auto max = static_cast<std::uint32_t>(numberOf(options_.settings, "transparency-buckets"));
        const std::vector<TransparencyBucket> buckets = transparencyBuckets(plan_, max);
        prepareTargets(!buckets.empty());
        scene_.prepare(plan_);
        frame_.upload(scene_.world(), plan_, 1);
        pinhole_->prepare(plan_, frame_, buckets);
        process_->start(plan_, frame_);
        stats_.trianglesDrawn = 0;
        stats_.peakBytes = std::max<std::uint64_t>(
            stats_.peakBytes, scene_.bytes() + frame_.bytes() + pinhole_->bytes() + process_->bytes() +
                                  layer_->bytes() + sum_->bytes() + coverage_.bytes() + radiance_.bytes());
        clock_.beginFrame();
    }

    bool advance() override {
        const std::uint32_t index = sum_->samples();
        const std::uint32_t total = sampleTotal();
        if (index >= total) return false;
        clock_.beginWave();
        pinhole_->draw(index);
        layer_->begin();
        process_->draw(pinhole_->image(), frame_, layer_->target());
        if (plan_.needsAlpha) drawCoverage();
        for (std::size_t bucket = 0; bucket < pinhole_->buckets(); ++bucket)
            layOver(pinhole_->drawBucket(index, bucket));
        sum_->add(*layer_, frame_, index, 1);
        clock_.endWave();
        stats_.trianglesDrawn += plan_.trianglesDrawn / total;
        if (index + 1 == total) clock_.endFrame();
        return index + 1 < total;
    }

    [[nodiscard]] std::uint32_t samples() const override { return sum_ ? sum_->samples() : 0; }
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] Image image() override { return sum_->mean(); }
    [[nodiscard]] const GlTexture* imageTexture() override { return &sum_->meanTexture(); }

    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = stats_;
        stats.samples = samples();
        clock_.fill(stats);
        stats.wave = 1;
        stats.layerFormat = layerFormatName(sum_->info().format);
        return stats;
    }

private:
    void blurCoverage(PinholeImage& pinhole) {
        pinhole.readAsCoverage(true);
        process_->draw(pinhole, frame_, coverageTarget_);
        pinhole.readAsCoverage(false);
    }

    // Writes the blurred coverage of the pinhole image into the layer's alpha.
    void drawCoverage() {
        blurCoverage(pinhole_->image());
        layer_->target().bind();
        coverage_.attach(0);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
        fullscreen_.draw(coverageToAlpha_);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    // Blurs the image of a bucket of blended objects and composites it over the layer.
    void layOver(PinholeImage& bucket) {
        if (!process_->blursAsTheLens()) bucket.part.reset();
        process_->draw(bucket, frame_, radianceTarget_);
        blurCoverage(bucket);
        layer_->target().bind();
        radiance_.attach(0);
        coverage_.attach(1);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, plan_.needsAlpha ? GL_TRUE : GL_FALSE);
        {
            const Scissor scissor(bucket.part);
            fullscreen_.drawOver(bucketOver_);
        }
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    // Allocates an intermediate image of the frame's size and format, unless `image` already has them.
    void prepareImage(GlTexture& image, Target& target) const {
        const LayerSumInfo& frame = sum_->info();
        const TextureFormat format = layerTextureFormat(frame.format);
        const TextureInfo& now = image.info();
        if (image && now.width == frame.width && now.height == frame.height && now.format == format) return;
        image = GlTexture({.format = format, .width = frame.width, .height = frame.height});
        target = Target({&image});
    }

    void prepareProgram(Program& program, const char* shader) const {
        if (!program) program = Program({{fullscreenShader, shader}, {}, options_.shaderFolder});
    }

    void prepareTargets(bool hasBuckets) {
        const LayerFormat format = chosenLayerFormat(scene_.world(), options_.layerFormat);
        const View& view = plan_.view;
        const bool same = sum_ && sum_->info().width == view.width && sum_->info().height == view.height &&
                          sum_->info().format == format && pinhole_->hasOwnBlur() == plan_.usesOwnBlur;
        if (!same) {
            layer_.reset();  // free the old layer and sum first: memory might not suffice for old and new ones
            sum_.reset();
            layer_.emplace(WaveLayersInfo{view.width, view.height, 1, format});
            sum_.emplace(LayerSumInfo{view.width, view.height, format, options_.shaderFolder});
            pinhole_.emplace(scene_, view.width, view.height, format, plan_.usesOwnBlur, process_->samplesPerPixel(),
                             options_.shaderFolder);
        }
        sum_->reset();
        if (plan_.needsAlpha) prepareProgram(coverageToAlpha_, "post_process/coverage_to_alpha.frag");
        if (plan_.needsAlpha || hasBuckets) prepareImage(coverage_, coverageTarget_);
        if (!hasBuckets) return;
        prepareProgram(bucketOver_, "post_process/bucket_over.frag");
        prepareImage(radiance_, radianceTarget_);
    }

    RendererOptions options_;
    std::unique_ptr<PostProcess> process_;
    GpuScene scene_;
    FramePlan plan_;
    FrameUniforms frame_;
    std::optional<WaveLayers> layer_;
    std::optional<LayerSum> sum_;
    std::optional<PinholePass> pinhole_;
    // Blurred coverage. Used only with a transparent background or with transparency buckets, which are groups of
    // blended objects that are blurred separately.
    GlTexture coverage_;
    GlTexture radiance_;  // blurred radiance of a transparency bucket; used only with transparency buckets
    Target coverageTarget_, radianceTarget_;
    Program coverageToAlpha_, bucketOver_;
    Fullscreen fullscreen_;
    mutable FrameClock clock_;
    RenderStats stats_;
};

}  // namespace

MethodSetting pinholesSetting() {
    return {.name = "pinholes",
            .defaultValue = "4",
            .description =
                "Number of sharp (pinhole) images per frame, with subpixel offsets for antialiasing; 1 in the "
                "published methods. With --method layered, each image has its own layers and an equal share of the "
                "lens samples",
            .choices = {},
            .min = 1,
            .max = 64};
}

MethodSetting transparencyBucketsSetting(const char* defaultValue) {
    return {.name = "transparency-buckets",
            .defaultValue = defaultValue,
            .description =
                "Maximum number of depth groups in which alpha-blended surfaces are blurred separately from their "
                "background; 0: blur surfaces and background together",
            .choices = {},
            .min = 0,
            .max = 8};
}

MethodSetting maxCocSetting(const char* defaultValue) {
    return {.name = "max-coc",
            .defaultValue = defaultValue,
            .description =
                "Maximum blur diameter. published: the value in the slides of the method. For --method scheuermann, "
                "this is 10 px. For --method circular, it is 17 px at the resolution of the blurred images, which is "
                "68 px in the final image with --resolution quarter",
            .choices = {"published", "unlimited"}};
}

std::unique_ptr<Renderer> makePostProcessRenderer(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<PostProcess> process) {
    return std::make_unique<PostProcessRenderer>(world, options, std::move(process));
}

}  // namespace defocus::engine
