#include "render/multirate/multirate.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "gl/timer.h"
#include "plan/rates.h"
#include "render/accumulation/layer_sum.h"
#include "render/frame_clock.h"
#include "render/multirate/group_layers.h"
#include "render/shadow_maps.h"
#include "render/surface_pass.h"

namespace defocus {

namespace {

static_assert(rateBlock == blockSamples);

// As many layers as the memory allows, at most a block; groups take half as many again, each with the shadow maps of
// several samples.
std::uint32_t chosenSampleLayers(const FramePlan& plan, const RendererOptions& options, std::uint32_t asked,
                                 LayerFormat format) {
    const std::uint64_t layerBytes = std::uint64_t{static_cast<std::uint32_t>(plan.view.width)} *
                                         static_cast<std::uint32_t>(plan.view.height) * layerPixelBytes(format) *
                                         (plan.usesTransmission ? 2 : 1) +  // with the backdrop
                                     shadowMapBytes(plan) * (2 + mostPointsPerSample(plan.shadows.maps.size())) / 3;
    const std::uint64_t wanted = asked > 0 ? asked : options.waveBytes / layerBytes * 2 / 3;
    const std::uint64_t most = std::min<std::uint64_t>(blockSamples, plan.samples.size());
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, 1, most));
}

std::uint64_t trianglesDrawn(const FramePlan& plan, std::uint32_t first, std::uint32_t count) {
    std::uint64_t triangles = 0;
    for (const ObjectPlan& object : plan.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine}) {
            const std::uint32_t begin = std::max(first, draw.firstSample);
            const std::uint32_t end = std::min(first + count, draw.firstSample + draw.sampleCount);
            if (begin < end) triangles += std::uint64_t{end - begin} * draw.triangleCount;
        }
    return triangles;
}

// The surfaces of a block, drawn for its samples or for its groups.
struct BlockDraws {
    FramePlan plan;
    FrameUniforms frame;
    std::optional<ShadowMaps> shadows;
    std::optional<SurfacePass> surfaces;

    void prepare(const World& world, FramePlan block, std::uint32_t layers) {
        plan = std::move(block);
        frame.upload(world, plan, layers);
        shadows->prepare(plan, frame);
        surfaces->prepare(plan, frame, &*shadows);
    }
    [[nodiscard]] std::size_t bytes() const {
        return frame.bytes() + (surfaces ? surfaces->bytes() + shadows->bytes() : 0);
    }
};

class MultirateRenderer final : public Renderer {
public:
    MultirateRenderer(const World& world, const RendererOptions& options)
        : options_(options), wave_(options.wave), scene_(world) {}

    void setWave(std::uint32_t samples) override { wave_ = samples > 0 ? samples : options_.wave; }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        plan_ = plan;
        prepareTarget();
        samplesBefore_ = 0;
        stats_.trianglesDrawn = 0;
        for (GpuTimer* timer : {&groupTimer_, &shadowTimer_, &opaqueTimer_, &skyTimer_, &translucentTimer_, &sumTimer_})
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
        prepareFrame();
    }

    bool advance() override {
        const std::uint32_t first = sum_->samples() - samplesBefore_;  // of the plan's
        const auto total = static_cast<std::uint32_t>(plan_.samples.size());
        if (first >= total) return false;
        const std::uint32_t inBlock = first % blockSamples;
        if (inBlock == 0 && first > 0) prepareBlock(first);
        const std::uint32_t count = std::min({sum_->info().layers, total - first, blockSamples - inBlock});
        clock_.beginWave();
        drawWave(inBlock, count);
        clock_.endWave();
        if (first + count == total) clock_.endFrame();
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
        stats.passes = {{"groups", groupTimer_.milliseconds()}};
        if (!samples_.shadows->defines().empty()) stats.passes.push_back({"shadows", shadowTimer_.milliseconds()});
        stats.passes.push_back({"opaque", opaqueTimer_.milliseconds()});
        if (drawsSky()) stats.passes.push_back({"sky", skyTimer_.milliseconds()});
        if (samples_.surfaces->hasTranslucent())
            stats.passes.push_back({"translucent", translucentTimer_.milliseconds()});
        stats.passes.push_back({"sum", sumTimer_.milliseconds()});
        return stats;
    }

private:
    void prepareFrame() {
        scene_.prepare(plan_);
        rates_ = frameRates(plan_);
        prepareBlock(0);
        clock_.beginFrame();
    }

    // The draws of the block that begins with the plan's sample `first`.
    void prepareBlock(std::uint32_t first) {
        const auto total = static_cast<std::uint32_t>(plan_.samples.size());
        RatedBlock block = ratedBlock(plan_, rates_, first, std::min(blockSamples, total - first));
        groupSize_ = block.groupSize;
        groupsShare_ = block.groupsShare;
        sharedAreas_ = std::move(block.sharedAreas);
        groupsDrawn_ = 0;
        samples_.prepare(scene_.world(), std::move(block.samples), sum_->info().layers);
        if (groupsShare_ > 0) {
            if (!groupLayers_) groupLayers_.emplace(*sum_);
            groups_.prepare(scene_.world(), std::move(block.groups), groupLayers_->count());
        }
        stats_.peakBytes =
            std::max<std::uint64_t>(stats_.peakBytes, scene_.bytes() + samples_.bytes() + groups_.bytes() +
                                                          sum_->bytes() + (groupLayers_ ? groupLayers_->bytes() : 0));
    }

    // The sums and the passes that fill them, made anew only when size or format change.
    void prepareTarget() {
        const LayerFormat format = chosenLayerFormat(scene_.world(), plan_, options_.layerFormat);
        const LayerSumInfo info{plan_.view.width, plan_.view.height, chosenSampleLayers(plan_, options_, wave_, format),
                                format, options_.shaderFolder};
        const bool same = sum_ && sum_->info().width == info.width && sum_->info().height == info.height &&
                          sum_->info().layers == info.layers && sum_->info().format == info.format;
        if (!same) {
            groupLayers_.reset();  // both before the new ones are made, as all may not fit
            sum_.reset();
            sum_.emplace(info);
            const bool vertexShaderLayers = vertexShaderMayPickLayer() && !options_.geometryShaderLayers;
            for (BlockDraws* draws : {&samples_, &groups_}) {
                draws->shadows.emplace(scene_, vertexShaderLayers, options_.shaderFolder);
                draws->surfaces.emplace(scene_, SurfacePassInfo{.fragmentShader = "accumulation/object.frag",
                                                                .defines = layerFormatDefines(format),
                                                                .vertexShaderLayers = vertexShaderLayers,
                                                                .shaderFolder = options_.shaderFolder});
            }
        }
        sum_->reset();
    }

    // Simpler skies are composed when layers are added, unless something shows them through itself.
    [[nodiscard]] bool drawsSky() const {
        const EnvironmentType type = scene_.world().environment.type;
        return !plan_.needsAlpha && (type == EnvironmentType::map || plan_.usesTransmission);
    }

    static void timed(GpuTimer& timer, const auto& pass) {
        timer.begin();
        pass();
        timer.end();
    }

    // Draws the images of the groups of samples [first, end) of the block that aren't there yet.
    void drawGroups(std::uint32_t first, std::uint32_t end) {
        const std::uint32_t begin = std::max(groupsDrawn_, first / groupSize_);
        const std::uint32_t groupEnd = std::min((end + groupSize_ - 1) / groupSize_, groupsShare_);
        if (begin >= groupEnd) return;
        groups_.shadows->draw(begin, groupEnd - begin);
        groupLayers_->begin(begin, groupEnd);
        groups_.surfaces->drawOpaque(begin, groupEnd - begin);
        stats_.trianglesDrawn += trianglesDrawn(groups_.plan, begin, groupEnd - begin);
        groupsDrawn_ = groupEnd;
    }

    // The wave's layers, each with what its group shares.
    void beginWave(std::uint32_t first, std::uint32_t count) {
        sum_->beginWave();
        if (groupsShare_ == 0) return;
        for (std::uint32_t layer = 0; layer < count; ++layer)
            if (const std::uint32_t group = (first + layer) / groupSize_; group < groupsShare_)
                groupLayers_->copyTo(*sum_, layer, group, sharedAreas_);
    }

    // Samples [first, first + count) of the block.
    void drawWave(std::uint32_t first, std::uint32_t count) {
        if (groupsShare_ > 0) timed(groupTimer_, [&] { drawGroups(first, first + count); });
        if (!samples_.shadows->defines().empty()) timed(shadowTimer_, [&] { samples_.shadows->draw(first, count); });
        timed(opaqueTimer_, [&] {
            beginWave(first, count);
            samples_.surfaces->drawOpaque(first, count);
        });
        if (drawsSky()) timed(skyTimer_, [&] { samples_.surfaces->drawSky(first, count); });
        if (samples_.surfaces->hasTranslucent())
            timed(translucentTimer_, [&] { samples_.surfaces->drawTranslucent(first, count, sum_->layerColors()); });
        timed(sumTimer_, [&] { sum_->endWave(samples_.frame, first, count); });
        stats_.trianglesDrawn += trianglesDrawn(samples_.plan, first, count);
    }

    RendererOptions options_;
    std::uint32_t wave_;  // K asked for; 0: as many as waveBytes allow
    GpuScene scene_;
    FramePlan plan_;
    FrameRates rates_;
    std::uint32_t samplesBefore_ = 0;  // in the sum when the plan was begun
    // Of the block that the next sample belongs to.
    BlockDraws samples_;
    BlockDraws groups_;
    std::uint32_t groupsShare_ = 0;
    std::vector<PixelArea> sharedAreas_;
    std::uint32_t groupSize_ = 1;
    std::uint32_t groupsDrawn_ = 0;  // groups before this one have been drawn
    std::optional<LayerSum> sum_;
    std::optional<GroupLayers> groupLayers_;
    mutable FrameClock clock_;
    mutable GpuTimer groupTimer_, shadowTimer_, opaqueTimer_, skyTimer_, translucentTimer_, sumTimer_;
    RenderStats stats_;
};

}  // namespace

std::unique_ptr<Renderer> makeMultirateRenderer(const World& world, const RendererOptions& options) {
    return std::make_unique<MultirateRenderer>(world, options);
}

}  // namespace defocus
