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
#include "render/accumulation/wave_queue.h"
#include "render/sampling/frame_clock.h"

namespace defocus::engine {

namespace {

// Max samples that are drawn together, as one batch (wave). The image's error may be estimated after each multiple of
// this number of samples, so a batch must not extend across a multiple.
constexpr std::uint32_t maxWave = 16;
// Max samples per batch (wave) if several threads draw. Small batches divide the samples evenly between threads.
constexpr std::uint32_t maxSharedWave = 4;
// Max triangles per batch (wave) with a software driver. The driver keeps all triangles of a batch in memory and frees
// this memory afterwards. The next batch allocates it again, and for large batches the page faults can take longer than
// the drawing.
constexpr std::uint64_t maxWaveTriangles = 400'000;
// maxWaveTriangles does not reduce a batch (wave) below this number of samples: each batch takes a pass that adds it to
// the sum, so small batches are slow.
constexpr std::uint64_t minWaveOfTriangles = 4;

// Returns the max number of layers in memory, each the image of one sample: the number set by `limit` or by `options`,
// else as many as fit into RendererOptions::waveBytes.
std::uint64_t maxLayers(const Scene& scene, const FramePlan& plan, const RendererOptions& options,
                        const WaveLimit& limit, LayerFormat format) {
    const std::uint32_t asked = limit.samples > 0 ? limit.samples : options.wave;
    if (asked > 0) return asked;
    const LayerWindow window = layerWindow(plan);
    const std::uint64_t pixels = pixelCount(window.layerWidth, window.layerHeight);
    const std::uint64_t layerBytes =
        pixels * layerPixelBytes(format) * (plan.usesTransmission ? 2 : 1) +  // transmission needs a copy of all layers
        shadowMapBytes(scene, plan) + pixels * LensLayers::layerBytes(plan.settings.layers, countsSamples(plan));
    return std::max<std::uint64_t>(1, options.waveBytes / layerBytes);
}

// Returns how the plan's samples are divided into batches (waves) and threads, with at most `layers` layers in memory.
WaveShape chosenShape(const FramePlan& plan, const RendererOptions& options, const WaveLimit& limit,
                      std::uint64_t layers) {
    const std::uint64_t samples = std::max<std::uint64_t>(1, plan.samples.size());
    // The error of a frame with few samples is estimated after half of the samples, so a batch has at most half of
    // them.
    std::uint64_t longest =
        std::min<std::uint64_t>(limit.perWave > 0 ? limit.perWave : maxWave, std::max<std::uint64_t>(1, samples / 2));
    if (currentIsSoftware()) {
        const std::uint64_t triangles = std::max<std::uint64_t>(1, plan.trianglesDrawn);
        longest = std::min(longest, std::max(minWaveOfTriangles, maxWaveTriangles * samples / triangles));
    }
    WaveShape shape;
    const std::uint32_t threads = limit.threads > 0 ? limit.threads : options.threads;
    shape.threads = static_cast<std::uint32_t>(std::min<std::uint64_t>({threads, layers, samples}));
    shape.targets = shape.threads > 1 && 2 * shape.threads <= std::min(layers, samples) ? 2 : 1;
    const auto power = [](std::uint64_t max) { return std::bit_floor(static_cast<std::uint32_t>(max)); };
    if (shape.threads <= 1) {
        shape.samples = power(std::min({layers, samples, longest, std::uint64_t{maxWave}}));
    } else {
        // Number of samples per batch if each thread draws four batches.
        const std::uint64_t even = std::max<std::uint64_t>(1, samples / (4 * shape.threads));
        shape.samples = power(std::min({layers / shape.waves(), even, longest, std::uint64_t{maxSharedWave}}));
    }
    return shape;
}

// Returns the values at the top left subpixel position of each pixel. A pixel has `axis` x `axis` subpixel positions.
Image ofFirstPositions(Image drawn, int axis) {
    if (axis == 1) return drawn;
    Image result(drawn.width / axis, drawn.height / axis, 1);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) *result.at(x, y) = *drawn.at(x * axis, y * axis);
    return result;
}

// Says when each sample's image is blurred as its lens cell would blur it. The cell is the part of the lens that the
// sample represents, and the blur fills gaps between samples. With `automatic`, images are blurred if enough of the
// frame has a large CoC (automatic_cells.h).
enum class CellUse { never, always, automatic };

class AccumulationRenderer final : public Renderer {
public:
    AccumulationRenderer(const World& world, const RendererOptions& options, CellUse cellUse)
        : options_(options), cellUse_(cellUse), scene_(world, options.pendingBytes), waves_(scene_, options) {}

    void setWave(const WaveLimit& limit) override { limit_ = limit; }

    void start(const FramePlan& plan) override {
        clock_.beginSetup();
        waves_.stop();  // the batches of the previous frame refer to plan_, which setPlan() replaces
        setPlan(plan);
        prepareSums();
        samplesBefore_ = 0;
        stats_.trianglesDrawn = stats_.trianglesHidden = 0;
        waves_.resetTimes();
        sumTimer_.reset();
        if (layers_) layers_->reset();
        prepareFrame();
    }

    void continueWith(const FramePlan& plan) override {
        const bool completeBlocks = sum_ && samples() == sampleTotal() && samples() % blockSamples == 0;
        if (!completeBlocks || plan.view.width != plan_.view.width || plan.view.height != plan_.view.height)
            fail(
                "samples can be added only if the current block of samples is complete and the image size has not "
                "changed");
        clock_.beginSetup();
        waves_.stop();
        samplesBefore_ = samples();
        setPlan(plan);
        prepareFrame();
    }

    bool advance() override {
        if (samples() == sampleTotal()) return false;
        const DrawnWave wave = waves_.next();
        latest_ = wave.layers;
        clock_.beginWave();
        sumTimer_.measure([&] { sum_->add(wave.layers->picture, frame_, wave.first, wave.count); });
        if (layers_) layers_->add(*wave.layers->data, frame_, wave.first, wave.count);
        clock_.endWave();
        stats_.trianglesDrawn += trianglesDrawn(plan_, wave.first, wave.count);
        stats_.trianglesHidden += wave.hiddenTriangles;
        const bool ended = samples() == sampleTotal();
        if (ended) {
            sum_->makeMean();  // before endFrame(), so that the frame's time includes the computation of the mean
            clock_.endFrame();
        }
        return !ended;
    }

    [[nodiscard]] std::uint32_t samples() const override { return sum_ ? sum_->samples() : 0; }
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return samplesBefore_ + static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] Image image() override { return sum_->mean(); }
    [[nodiscard]] const GlTexture* imageTexture() override { return &sum_->meanTexture(); }

    [[nodiscard]] std::optional<BlockSum> blockSum() override { return sum_->block(); }

    [[nodiscard]] std::optional<Image> sampleDepth() override {
        Image depth = ofFirstPositions(readBack(latest_->picture.depths(), 1), positionsPerAxis(plan_.settings));
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
        stats.wave = waves_.layers();
        stats.threads = waves_.threads();
        if (sum_) stats.layerFormat = layerFormatName(sum_->info().format);  // no frame may have been drawn yet
        stats.passes = waves_.times();
        for (const PassTime& pass : stats.passes) stats.gpuMilliseconds += pass.milliseconds;
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
        frame_.upload(scene_.world(), plan_, shape_.samples);
        const LayerWindow window = layerWindow(plan_);
        waves_.prepare({.plan = &plan_,
                        .uniforms = &frame_,
                        .layers = {window.layerWidth, window.layerHeight, shape_.samples, sum_->info().format},
                        .window = plan_.tile ? std::optional(window) : std::nullopt,
                        .skipsHidden = skipsHidden(),
                        .countsSamples = countsSamples_,
                        .marksBlended = blursCells(),
                        .drawsSky = drawsSky()},
                       shape_);
        stats_.peakBytes =
            std::max<std::uint64_t>(stats_.peakBytes, scene_.bytes() + frame_.bytes() + waves_.bytes() + sum_->bytes() +
                                                          (layers_ ? layers_->bytes() : 0));
        clock_.beginFrame();
    }

    [[nodiscard]] bool blursCells() const { return cells_.classes() > 0; }

    // Divides the samples into batches (waves), clears the accumulation buffers, and reallocates them if their size or
    // format has changed.
    void prepareSums() {
        const LayerFormat format = chosenLayerFormat(scene_.world(), options_.layerFormat);
        shape_ =
            chosenShape(plan_, options_, limit_, maxLayers(*scene_.world().scene, plan_, options_, limit_, format));
        const LayerWindow window = layerWindow(plan_);
        const int axis = positionsPerAxis(plan_.settings);
        const LayerSumInfo info{window.width / axis, window.height / axis, format, options_.shaderFolder};
        const std::vector<Layer>& layers = plan_.settings.layers;
        const bool counts = countsSamples(plan_);
        const bool same = sum_ && sum_->info() == info && drawnLayers_ == layers && countsSamples_ == counts;
        if (!same) {
            layers_.reset();
            sum_.reset();  // free the old buffers first: there may not be enough memory for both
            sum_.emplace(info);
            if (!layers.empty())
                layers_.emplace(layers, counts, glm::ivec2(info.width, info.height), options_.shaderFolder);
            drawnLayers_ = layers;
            countsSamples_ = counts;
        }
        sum_->reset({window.left, window.bottom});
    }

    // Returns whether the environment is drawn into each sample's layer. If the output needs alpha, it is never drawn.
    // Otherwise, an environment map is always drawn. A gradient or a single colour is drawn if it may be visible
    // through a transmitting surface, or if lens cells blur images with blended surfaces: an alpha above 1 marks these
    // surfaces, so pixels of the environment need alpha 1. In other cases, a gradient or a colour is composited behind
    // the layers when they are added to the sum.
    [[nodiscard]] bool drawsSky() const {
        const EnvironmentType type = scene_.world().environment.type;
        return !plan_.needsAlpha &&
               (type == EnvironmentType::map || plan_.usesTransmission || (blursCells() && plan_.sortsBlending));
    }

    // Returns whether to cull hidden triangles. On a GPU, drawing them is faster than reading back the depths for the
    // occlusion test.
    [[nodiscard]] bool skipsHidden() const { return currentIsSoftware() && !plan_.settings.keepAll; }

    RendererOptions options_;
    WaveLimit limit_;
    CellUse cellUse_;
    GpuScene scene_;
    FramePlan plan_;
    // Parts of the lens that the samples of plan_ represent. cells_.classes() is 0 if the samples' images are not
    // blurred.
    LensCells cells_;
    std::uint32_t samplesBefore_ = 0;  // number of samples in the sum when the drawing of plan_ began
    FrameUniforms frame_;
    WaveShape shape_;
    std::optional<LayerSum> sum_;
    std::vector<Layer> drawnLayers_;  // data layers, such as depth, that layers_ sums
    bool countsSamples_ = false;      // whether layers_ counts the samples of each pixel
    mutable std::optional<LensLayers> layers_;
    mutable FrameClock clock_;
    mutable GpuTimer sumTimer_;
    RenderStats stats_;
    const WaveTargets* latest_ = nullptr;  // layers of the latest batch of samples
    mutable WaveQueue waves_;              // last member: its threads use the other members and must end first
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
