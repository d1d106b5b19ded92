// Sources: Haeberli and Akeley 1990, The Accumulation Buffer; Jeong, Kim and Lee 2011, Multi-Resolution Depth-of-Field
// Rendering.

#include "render/accumulation/accumulation.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "gl/read_back.h"
#include "gl/timer.h"
#include "plan/lens_cells/automatic_cells.h"
#include "plan/lens_cells/lens_cells.h"
#include "plan/sample_range.h"
#include "render/accumulation/layer_sum.h"
#include "render/accumulation/lens_layers.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/gpu_scene/surface_pass.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

// Max samples per wave. The image's error may be estimated at each multiple of this number, so waves must not cross a
// multiple.
constexpr std::uint32_t maxWave = 16;

// Returns the number of layers, which is the number of samples per wave: a power of two, at most 16. If `requested` is
// 0, it is the largest number that fits into RendererOptions::waveBytes.
std::uint32_t chosenWave(const Scene& scene, const FramePlan& plan, const RendererOptions& options,
                         std::uint32_t requested, LayerFormat format) {
    const LayerWindow window = layerWindow(plan);
    const std::uint64_t layerBytes =
        std::uint64_t{static_cast<std::uint32_t>(window.layerWidth)} * static_cast<std::uint32_t>(window.layerHeight) *
            layerPixelBytes(format) * (plan.usesTransmission ? 2 : 1) +  // the backdrop is a copy of all layers
        shadowMapBytes(scene, plan) +
        std::uint64_t{static_cast<std::uint32_t>(window.layerWidth)} * static_cast<std::uint32_t>(window.layerHeight) *
            LensLayers::layerBytes(plan.settings.layers);
    const std::uint64_t fitting =
        requested > 0 ? requested : std::max<std::uint64_t>(1, options.waveBytes / layerBytes);
    return std::bit_floor(static_cast<std::uint32_t>(std::min<std::uint64_t>({fitting, maxWave, plan.samples.size()})));
}

bool sameSizes(const LayerSumInfo& a, const LayerSumInfo& b) {
    return a.width == b.width && a.height == b.height && a.layers == b.layers && a.sumWidth == b.sumWidth &&
           a.sumHeight == b.sumHeight;
}

// Whether each sample's image is blurred by its lens cell. `automatic` decides by the blur in the image
// (automatic_cells.h).
enum class CellUse { never, always, automatic };

class AccumulationRenderer final : public Renderer {
public:
    AccumulationRenderer(const World& world, const RendererOptions& options, CellUse cellUse)
        : options_(options), wave_(options.wave), cellUse_(cellUse), scene_(world, options.pendingBytes) {}

    void setWave(std::uint32_t samples) override { wave_ = samples > 0 ? samples : options_.wave; }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        setPlan(plan);
        prepareTarget();
        samplesBefore_ = 0;
        stats_.trianglesDrawn = stats_.trianglesHidden = 0;
        for (GpuTimer* timer : {&shadowTimer_, &opaqueTimer_, &skyTimer_, &translucentTimer_, &sumTimer_})
            timer->reset();
        if (layers_) layers_->reset();
        prepareFrame();
    }

    void continueWith(const FramePlan& plan) override {
        const bool wholeBlocks = sum_ && samples() == sampleTotal() && samples() % blockSamples == 0;
        if (!wholeBlocks || plan.view.width != plan_.view.width || plan.view.height != plan_.view.height)
            fail(
                "samples can be added only after the current block of samples is complete, and at the same image size");
        clock_.beginSetup();
        samplesBefore_ = samples();
        setPlan(plan);
        prepareFrame();
    }

    bool advance() override {
        // `first` is the index of the wave's first sample within the plan.
        const std::uint32_t first = sum_->samples() - samplesBefore_;
        const auto total = static_cast<std::uint32_t>(plan_.samples.size());
        if (first >= total) return false;
        const std::uint32_t count = std::min(sum_->info().layers, total - first);
        clock_.beginWave();
        drawWave(first, count);
        clock_.endWave();
        if (first + count == total) {
            sum_->makeMean();  // before endFrame(), so that the frame's time includes the mean
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

    [[nodiscard]] std::optional<Image> sampleDepth() override {
        Image depth = readBack(sum_->layerDepths(), 1);
        // The depth buffer holds near plane / depth.
        for (float& value : depth.pixels) value = static_cast<float>(plan_.view.nearPlane / static_cast<double>(value));
        return depth;
    }

    [[nodiscard]] std::optional<LayerImages> layerImages() override {
        if (!layers_) return {};
        return layers_->images(glm::dvec3(plan_.view.worldFromCamera[3]));
    }

    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = stats_;
        stats.samples = samples();
        clock_.fill(stats);
        stats.wave = sum_->info().layers;
        stats.layerFormat = layerFormatName(sum_->info().format);
        if (!shadows_->defines().empty()) stats.passes.push_back({"shadows", shadowTimer_.milliseconds()});
        stats.passes.push_back({"opaque", opaqueTimer_.milliseconds()});
        if (drawsSky()) stats.passes.push_back({"sky", skyTimer_.milliseconds()});
        if (surfaces_->hasTranslucent()) stats.passes.push_back({"translucent", translucentTimer_.milliseconds()});
        stats.passes.push_back({"sum", sumTimer_.milliseconds()});
        if (layers_) std::ranges::copy(layers_->times(), std::back_inserter(stats.passes));
        return stats;
    }

private:
    void setPlan(const FramePlan& plan) {
        plan_ = plan;
        cells_ = {};
        const bool wanted =
            cellUse_ == CellUse::automatic ? reasonForAccumulation(plan_).empty() : cellUse_ == CellUse::always;
        if (!wanted) return;
        cells_ = lensCells(plan_);
        moveToCells(plan_, cells_);
    }

    void prepareFrame() {
        scene_.prepare(plan_);
        sum_->blurCells(cells_);
        frame_.upload(scene_.world(), plan_, sum_->info().layers);
        shadows_->prepare(plan_, frame_);
        surfaces_->prepare(plan_, frame_, &*shadows_);
        surfaces_->markBlended(blursCells());
        if (leavesOutHidden()) surfaces_->findHidden(plan_);
        stats_.peakBytes = std::max<std::uint64_t>(
            stats_.peakBytes, scene_.bytes() + frame_.bytes() + surfaces_->bytes() + shadows_->bytes() + sum_->bytes() +
                                  (layers_ ? layers_->bytes() : 0));
        clock_.beginFrame();
    }

    [[nodiscard]] bool blursCells() const { return cells_.classes() > 0; }

    // Reallocates the sums if their size or format has changed, and the passes if the format has changed.
    void prepareTarget() {
        const LayerFormat format = chosenLayerFormat(scene_.world(), options_.layerFormat);
        const LayerWindow window = layerWindow(plan_);
        const LayerSumInfo info{.width = window.layerWidth,
                                .height = window.layerHeight,
                                .layers = chosenWave(*scene_.world().scene, plan_, options_, wave_, format),
                                .format = format,
                                .shaderFolder = options_.shaderFolder,
                                .sumWidth = window.width,
                                .sumHeight = window.height};
        const std::vector<Layer>& layers = plan_.settings.layers;
        const bool countsSamples = plan_.view.lens.catEye > 0;
        const bool sameLayers = drawnLayers_ == layers && countsSamples_ == countsSamples;
        const bool sameFormat = sum_ && sum_->info().format == format && sameLayers;
        const bool sameTarget = sameFormat && sameSizes(sum_->info(), info);
        if (!sameTarget) {
            layers_.reset();
            sum_.reset();  // free the old sums first, because memory may not suffice for both
            sum_.emplace(info);
            if (!layers.empty()) layers_.emplace(layers, *sum_, countsSamples);
            drawnLayers_ = layers;
            countsSamples_ = countsSamples;
        }
        SurfacePassInfo pass{.fragmentShader = "accumulation/object.frag",
                             .defines = layerFormatDefines(format),
                             .stochasticAlpha = true,
                             .vertexShaderLayers = vertexShaderMayPickLayer() && !options_.geometryShaderLayers,
                             .shaderFolder = options_.shaderFolder};
        if (layers_) {
            pass.fragmentShader = "accumulation/layers.frag";
            for (const auto& define : LensLayers::defines(layers, countsSamples)) pass.defines.push_back(define);
            const bool drawsCoc = std::ranges::find(layers, Layer::coc) != layers.end();
            pass.readsOwnBlur = drawsCoc;
            pass.readsPosition = drawsCoc || std::ranges::find(layers, Layer::position) != layers.end();
            pass.writesLayers = true;
            pass.writesNumbers = layers_->countsNumbers();
        }
        if (!sameFormat) {
            shadows_.emplace(scene_, pass.vertexShaderLayers, pass.shaderFolder);
            surfaces_.emplace(scene_, pass);
        }
        sum_->reset(plan_.tile ? std::optional(window) : std::nullopt);
    }

    // Returns whether the environment is drawn into the layers. An environment that is not a map is usually composited
    // when the layers are added to the sum. It must be drawn if it is visible through a transmitting surface, or if
    // alpha marks blended surfaces for the blur of lens cells.
    [[nodiscard]] bool drawsSky() const {
        const EnvironmentType type = scene_.world().environment.type;
        return !plan_.needsAlpha &&
               (type == EnvironmentType::map || plan_.usesTransmission || (blursCells() && plan_.sortsBlending));
    }

    static void timed(GpuTimer& timer, const auto& pass) {
        timer.begin();
        pass();
        timer.end();
    }

    // Draws the plan's samples [first, first + count) into the layers and adds them to the sum.
    void drawWave(std::uint32_t first, std::uint32_t count) {
        if (!shadows_->defines().empty()) timed(shadowTimer_, [&] { shadows_->draw(first, count); });
        timed(opaqueTimer_, [&] {
            sum_->beginWave();
            if (layers_) layers_->beginWave();
            drawOpaque(first, count);
        });
        if (drawsSky()) timed(skyTimer_, [&] { drawSky(first, count); });
        if (surfaces_->hasTranslucent())
            timed(translucentTimer_, [&] { surfaces_->drawTranslucent(first, count, sum_->layerColors()); });
        timed(sumTimer_, [&] { sum_->endWave(frame_, first, count); });
        if (layers_) layers_->endWave(frame_, first, count);
        stats_.trianglesDrawn += trianglesDrawn(plan_, first, count);
    }

    // Draws the sky into the picture's layers, but not into the data layers.
    void drawSky(std::uint32_t first, std::uint32_t count) {
        if (layers_) sum_->layers().bind();
        surfaces_->drawSky(first, count);
        if (layers_) layers_->bind();
    }

    void drawOpaque(std::uint32_t first, std::uint32_t count) {
        if (!leavesOutHidden()) return surfaces_->drawOpaque(first, count);
        const std::uint32_t layer = first % blockSamples % sum_->info().layers;
        stats_.trianglesHidden += surfaces_->drawOpaqueVisible(first, count, sum_->layerDepths(), layer);
    }

    // Returns whether to cull hidden triangles. On a GPU, drawing them is faster than reading back the depths for the
    // occlusion test.
    [[nodiscard]] bool leavesOutHidden() const { return currentIsSoftware() && !plan_.settings.keepAll; }

    RendererOptions options_;
    std::uint32_t wave_;  // requested samples per wave K; 0: as many as fit into waveBytes
    CellUse cellUse_;
    GpuScene scene_;
    FramePlan plan_;
    LensCells cells_;                  // lens cells of plan_; without blur classes, images are not blurred
    std::uint32_t samplesBefore_ = 0;  // samples in the sum when plan_ was started
    FrameUniforms frame_;
    std::optional<LayerSum> sum_;
    std::vector<Layer> drawnLayers_;  // layers of layers_ and surfaces_
    bool countsSamples_ = false;      // whether layers_ counts the samples of each pixel
    mutable std::optional<LensLayers> layers_;
    std::optional<ShadowMaps> shadows_;
    std::optional<SurfacePass> surfaces_;
    mutable FrameClock clock_;
    mutable GpuTimer shadowTimer_, opaqueTimer_, skyTimer_, translucentTimer_, sumTimer_;
    RenderStats stats_;
};

}  // namespace

std::unique_ptr<Renderer> makeAccumulationRenderer(const World& world, const RendererOptions& options) {
    return std::make_unique<AccumulationRenderer>(world, options, CellUse::never);
}

std::unique_ptr<Renderer> makeMultirateRenderer(const World& world, const RendererOptions& options) {
    return std::make_unique<AccumulationRenderer>(world, options, CellUse::always);
}

std::unique_ptr<Renderer> makeAutomaticRenderer(const World& world, const RendererOptions& options) {
    return std::make_unique<AccumulationRenderer>(world, options, CellUse::automatic);
}

}  // namespace defocus::engine
