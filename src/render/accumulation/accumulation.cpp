// Haeberli and Akeley 1990, The Accumulation Buffer; Jeong, Kim and Lee 2011, Multi-Resolution Depth-of-Field
// Rendering.

#include "render/accumulation/accumulation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"
#include "gl/context.h"
#include "gl/timer.h"
#include "plan/sample_range.h"
#include "plan/visible/shadows.h"
#include "render/accumulation/layer_sum.h"
#include "render/accumulation/shared_images.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

// Returns the number of layers per wave. A block is divided into the fewest equal waves that fit into the memory. With
// shared images, layers get two thirds of it: shared layers take at most half as much again, and have more shadow maps.
std::uint32_t chosenWave(const FramePlan& plan, const RendererOptions& options, std::uint32_t asked, LayerFormat format,
                         bool shares) {
    const LayerWindow window = layerWindow(plan);
    const std::uint64_t shadowBytes =
        shares ? shadowMapBytes(plan) * (2 + maxPointsPerSample(plan.shadows.maps.size())) / 3 : shadowMapBytes(plan);
    const std::uint64_t layerBytes = std::uint64_t{static_cast<std::uint32_t>(window.layerWidth)} *
                                         static_cast<std::uint32_t>(window.layerHeight) * layerPixelBytes(format) *
                                         (plan.usesTransmission ? 2 : 1) +  // the backdrop doubles the layers
                                     shadowBytes;
    const std::uint64_t block = std::min<std::uint64_t>(blockSamples, plan.samples.size());
    if (asked > 0) return static_cast<std::uint32_t>(std::min<std::uint64_t>(asked, block));
    const std::uint64_t fitting = std::max<std::uint64_t>(1, options.waveBytes / layerBytes * (shares ? 2 : 3) / 3);
    const std::uint64_t waves = (block + fitting - 1) / fitting;
    return static_cast<std::uint32_t>((block + waves - 1) / waves);
}

bool sameSizes(const LayerSumInfo& a, const LayerSumInfo& b) {
    return a.width == b.width && a.height == b.height && a.layers == b.layers && a.sumWidth == b.sumWidth &&
           a.sumHeight == b.sumHeight;
}

class AccumulationRenderer final : public Renderer {
public:
    AccumulationRenderer(const World& world, const RendererOptions& options, std::unique_ptr<SharedImages> shared)
        : options_(options), wave_(options.wave), scene_(world), shared_(std::move(shared)) {}

    void setWave(std::uint32_t samples) override { wave_ = samples > 0 ? samples : options_.wave; }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        plan_ = plan;
        if (shared_) shared_->prepareFrame(plan_);
        prepareTarget();
        samplesBefore_ = 0;
        stats_.trianglesDrawn = stats_.trianglesHidden = 0;
        for (GpuTimer* timer :
             {&sharedTimer_, &shadowTimer_, &opaqueTimer_, &skyTimer_, &translucentTimer_, &sumTimer_})
            timer->reset();
        prepareFrame();
    }

    void continueWith(const FramePlan& plan) override {
        const bool wholeBlocks = sum_ && samples() == sampleTotal() && samples() % blockSamples == 0;
        if (!wholeBlocks || plan.view.width != plan_.view.width || plan.view.height != plan_.view.height)
            fail("more samples were asked for before the block that was begun is whole");
        clock_.beginSetup();
        samplesBefore_ = samples();
        plan_ = plan;
        if (shared_) shared_->prepareFrame(plan_);
        prepareFrame();
    }

    bool advance() override {
        // First sample of the wave, counted within the plan.
        const std::uint32_t first = sum_->samples() - samplesBefore_;
        const auto total = static_cast<std::uint32_t>(plan_.samples.size());
        if (first >= total) return false;
        if (shared_ && first > 0 && first % blockSamples == 0) prepareDraws(first);
        const std::uint32_t count = std::min({sum_->info().layers, total - first, blockSamples - first % blockSamples});
        clock_.beginWave();
        drawWave(first - drawsBegin_, count);
        clock_.endWave();
        if (first + count == total) {
            sum_->makeMean();  // counted as frame time: the blur of cells and the division
            clock_.endFrame();
        }
        return first + count < total;
    }

    [[nodiscard]] std::uint32_t samples() const override { return sum_ ? sum_->samples() : 0; }
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return samplesBefore_ + static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] Image image() override { return sum_->mean(); }
    [[nodiscard]] const GlTexture* imageTexture() override { return &sum_->meanTexture(); }

    [[nodiscard]] std::optional<BlockSum> blockSum() override { return sum_->block(); }

    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = stats_;
        stats.samples = samples();
        clock_.fill(stats);
        stats.wave = sum_->info().layers;
        stats.layerFormat = layerFormatName(sum_->info().format);
        if (shared_) stats.passes.push_back({"shared", sharedTimer_.milliseconds()});
        if (!shadows_->defines().empty()) stats.passes.push_back({"shadows", shadowTimer_.milliseconds()});
        stats.passes.push_back({"opaque", opaqueTimer_.milliseconds()});
        if (drawsSky()) stats.passes.push_back({"sky", skyTimer_.milliseconds()});
        if (surfaces_->hasTranslucent()) stats.passes.push_back({"translucent", translucentTimer_.milliseconds()});
        stats.passes.push_back({"sum", sumTimer_.milliseconds()});
        return stats;
    }

private:
    void prepareFrame() {
        scene_.prepare(plan_);
        if (shared_) sum_->blurCells(shared_->cells());
        prepareDraws(0);
        clock_.beginFrame();
    }

    // Prepares the draws from the plan's sample `first` on: to the end of the plan, or with shared images to the end of
    // the block.
    void prepareDraws(std::uint32_t first) {
        drawsBegin_ = first;
        const auto total = static_cast<std::uint32_t>(plan_.samples.size());
        if (shared_) block_ = shared_->prepareBlock(first, std::min(blockSamples, total - first));
        frame_.upload(scene_.world(), draws(), sum_->info().layers);
        shadows_->prepare(draws(), frame_);
        surfaces_->prepare(draws(), frame_, &*shadows_);
        surfaces_->markBlended(blursCells());
        if (leavesOutHidden()) surfaces_->findHidden(draws());
        stats_.peakBytes = std::max<std::uint64_t>(
            stats_.peakBytes, scene_.bytes() + frame_.bytes() + surfaces_->bytes() + shadows_->bytes() + sum_->bytes() +
                                  (shared_ ? shared_->bytes() : 0));
    }

    [[nodiscard]] bool blursCells() const { return shared_ && shared_->cells().classes() > 0; }
    [[nodiscard]] const FramePlan& draws() const { return shared_ ? block_ : plan_; }

    // Reallocates the sums if size or format changed, and the passes if the format changed.
    void prepareTarget() {
        const LayerFormat format = chosenLayerFormat(scene_.world(), options_.layerFormat);
        const LayerWindow window = layerWindow(plan_);
        const LayerSumInfo info{.width = window.layerWidth,
                                .height = window.layerHeight,
                                .layers = chosenWave(plan_, options_, wave_, format, shared_ && !blursCells()),
                                .format = format,
                                .shaderFolder = options_.shaderFolder,
                                .sumWidth = window.width,
                                .sumHeight = window.height};
        const bool sameFormat = sum_ && sum_->info().format == format;
        const bool sameTarget = sameFormat && sameSizes(sum_->info(), info);
        if (!sameTarget) {
            if (shared_) shared_->releaseTarget();
            sum_.reset();  // frees the old sums first: memory may not hold both
            sum_.emplace(info);
        }
        const SurfacePassInfo pass{.fragmentShader = "accumulation/object.frag",
                                   .defines = layerFormatDefines(format),
                                   .vertexShaderLayers = vertexShaderMayPickLayer() && !options_.geometryShaderLayers,
                                   .shaderFolder = options_.shaderFolder};
        if (!sameFormat) {
            shadows_.emplace(scene_, pass.vertexShaderLayers, pass.shaderFolder);
            surfaces_.emplace(scene_, pass);
        }
        if (shared_ && !sameTarget) shared_->prepareTarget(scene_, pass, *sum_);
        sum_->reset(plan_.tile ? std::optional(window) : std::nullopt);
    }

    // Environments other than maps are composited when layers are added. They must be drawn earlier if a transmitting
    // surface shows them. The same holds if alpha marks blended surfaces for the blur of cells.
    [[nodiscard]] bool drawsSky() const {
        const EnvironmentType type = scene_.world().environment.type;
        return !plan_.needsAlpha &&
               (type == EnvironmentType::map || plan_.usesTransmission || (blursCells() && plan_.usesBlending));
    }

    static void timed(GpuTimer& timer, const auto& pass) {
        timer.begin();
        pass();
        timer.end();
    }

    // Draws samples [first, first + count) of the plan that draws() returns.
    void drawWave(std::uint32_t first, std::uint32_t count) {
        if (shared_) timed(sharedTimer_, [&] { stats_.trianglesDrawn += shared_->draw(first, count); });
        if (!shadows_->defines().empty()) timed(shadowTimer_, [&] { shadows_->draw(first, count); });
        timed(opaqueTimer_, [&] {
            sum_->beginWave();
            if (shared_) shared_->copyToLayers(first, count);
            drawOpaque(first, count);
        });
        if (drawsSky()) timed(skyTimer_, [&] { surfaces_->drawSky(first, count); });
        if (surfaces_->hasTranslucent())
            timed(translucentTimer_, [&] { surfaces_->drawTranslucent(first, count, sum_->layerColors()); });
        timed(sumTimer_, [&] { sum_->endWave(frame_, first, count); });
        stats_.trianglesDrawn += trianglesDrawn(draws(), first, count);
    }

    void drawOpaque(std::uint32_t first, std::uint32_t count) {
        if (!leavesOutHidden()) return surfaces_->drawOpaque(first, count);
        const std::uint32_t layer = first % blockSamples % sum_->info().layers;
        stats_.trianglesHidden += surfaces_->drawOpaqueVisible(first, count, sum_->layerDepths(), layer);
    }

    // Returns whether to cull hidden triangles. A GPU draws them faster than it reads back the depths for the test.
    [[nodiscard]] bool leavesOutHidden() const { return currentIsSoftware() && !plan_.settings.keepAll; }

    RendererOptions options_;
    std::uint32_t wave_;  // K requested; 0: as many as fit into waveBytes
    GpuScene scene_;
    FramePlan plan_;
    std::uint32_t samplesBefore_ = 0;       // samples in the sum when the plan was begun
    std::unique_ptr<SharedImages> shared_;  // null: every sample draws all objects
    FramePlan block_;                       // with shared images: the unshared draws of the current block
    std::uint32_t drawsBegin_ = 0;          // index in the plan of the first sample of draws()
    FrameUniforms frame_;
    std::optional<LayerSum> sum_;
    std::optional<ShadowMaps> shadows_;
    std::optional<SurfacePass> surfaces_;
    mutable FrameClock clock_;
    mutable GpuTimer sharedTimer_, shadowTimer_, opaqueTimer_, skyTimer_, translucentTimer_, sumTimer_;
    RenderStats stats_;
};

}  // namespace

std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options) {
    return std::make_unique<AccumulationRenderer>(world, options, nullptr);
}

std::unique_ptr<Renderer> makeSharingAccumulation(const World& world, const RendererOptions& options,
                                                  std::unique_ptr<SharedImages> shared) {
    return std::make_unique<AccumulationRenderer>(world, options, std::move(shared));
}

}  // namespace defocus::engine
