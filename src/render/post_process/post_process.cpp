#include "render/post_process/post_process.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "gl/fullscreen.h"
#include "render/accumulation/layer_sum.h"
#include "render/frame_clock.h"

namespace defocus {

namespace {

class PostProcessRenderer final : public Renderer {
public:
    PostProcessRenderer(const World& world, const RendererOptions& options, std::unique_ptr<PostProcess> process)
        : options_(options), process_(std::move(process)), scene_(world) {}

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        plan_ = pinholePlan(scene_.world(), plan, static_cast<std::uint32_t>(numberOf(options_.settings, "pinholes")));
        prepareTargets();
        scene_.prepare(plan_);
        frame_.upload(scene_.world(), plan_, 1);
        pinhole_->prepare(plan_, frame_);
        process_->start(plan_, frame_);
        stats_.trianglesDrawn = 0;
        stats_.peakBytes =
            std::max<std::uint64_t>(stats_.peakBytes, scene_.bytes() + frame_.bytes() + pinhole_->bytes() +
                                                          process_->bytes() + sum_->bytes() + coverage_.bytes());
        clock_.beginFrame();
    }

    bool advance() override {
        const std::uint32_t index = sum_->samples();
        const std::uint32_t total = sampleTotal();
        if (index >= total) return false;
        clock_.beginWave();
        pinhole_->draw(index);
        sum_->beginWave();
        process_->draw(*pinhole_, frame_, sum_->layers());
        if (plan_.needsAlpha) drawCoverage();
        sum_->endWave(frame_, index, 1);
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
    // Into the alpha of what is drawn.
    void drawCoverage() {
        pinhole_->readAsCoverage(true);
        process_->draw(*pinhole_, frame_, coverageTarget_);
        pinhole_->readAsCoverage(false);
        sum_->layers().bind();
        coverage_.attach(0);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
        fullscreen_.draw(coverageToAlpha_);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    void prepareCoverage(const View& view, LayerFormat format) {
        if (!coverageToAlpha_)
            coverageToAlpha_ =
                Program({{fullscreenShader, "post_process/coverage_to_alpha.frag"}, {}, options_.shaderFolder});
        if (coverage_ && coverage_.info().width == view.width && coverage_.info().height == view.height) return;
        coverage_ = GlTexture({.format = layerTextureFormat(format), .width = view.width, .height = view.height});
        coverageTarget_ = Target({&coverage_});
    }

    void prepareTargets() {
        const LayerFormat format = chosenLayerFormat(scene_.world(), plan_, options_.layerFormat);
        if (format != LayerFormat::rgba16f && format != LayerFormat::rgba32f)
            fail("layer format {}: post-process methods need rgba16f or rgba32f", layerFormatName(format));
        const View& view = plan_.view;
        const bool same = sum_ && sum_->info().width == view.width && sum_->info().height == view.height &&
                          sum_->info().format == format && pinhole_->hasOwnBlur() == plan_.usesOwnBlur;
        if (!same) {
            sum_.reset();  // before the new one is made: both may not fit
            sum_.emplace(LayerSumInfo{view.width, view.height, 1, format, options_.shaderFolder});
            pinhole_.emplace(scene_, view.width, view.height, format, plan_.usesOwnBlur, options_.shaderFolder);
        }
        sum_->reset();
        if (plan_.needsAlpha) prepareCoverage(view, format);
    }

    RendererOptions options_;
    std::unique_ptr<PostProcess> process_;
    GpuScene scene_;
    FramePlan plan_;
    FrameUniforms frame_;
    std::optional<LayerSum> sum_;
    std::optional<PinholePass> pinhole_;
    GlTexture coverage_;  // of a transparent background; empty where there was none yet
    Target coverageTarget_;
    Program coverageToAlpha_;
    Fullscreen fullscreen_;
    mutable FrameClock clock_;
    RenderStats stats_;
};

}  // namespace

MethodSetting pinholesSetting() {
    return {.name = "pinholes",
            .standard = "4",
            .description = "Pinhole images a frame, spread over the pixel: antialiasing",
            .choices = {},
            .least = 1,
            .most = 64};
}

std::unique_ptr<Renderer> makePostProcessRenderer(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<PostProcess> process) {
    return std::make_unique<PostProcessRenderer>(world, options, std::move(process));
}

}  // namespace defocus
