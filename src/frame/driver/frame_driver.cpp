#include "frame/driver/frame_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/stopwatch.h"
#include "gl/context.h"
#include "plan/render_settings.h"
#include "plan/sample_range.h"
#include "render/frame_run.h"
#include "render/sampling/automatic_samples.h"
#include "render/tiles/tile_walk.h"
#include "scene/ground.h"

namespace defocus::engine {

// ---- ways of drawing a frame: untiled, in tiles, as partial sums, one image per lens sample -------------------------

class FrameDriver::Drawing {
public:
    Drawing() = default;
    virtual ~Drawing() = default;
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    virtual bool advance() = 0;
    [[nodiscard]] virtual std::uint32_t samples() const = 0;
    [[nodiscard]] virtual std::uint32_t sampleTotal() const = 0;
    [[nodiscard]] virtual double share() const { return static_cast<double>(samples()) / sampleTotal(); }
    [[nodiscard]] virtual const FramePlan& plan() const = 0;
    [[nodiscard]] virtual RenderStats stats() const = 0;
    [[nodiscard]] virtual double planMilliseconds() const = 0;
    [[nodiscard]] virtual Image image() = 0;
    [[nodiscard]] virtual std::optional<FramePart> sums() { return {}; }
    [[nodiscard]] virtual int tiles() const { return 1; }
};

class FrameDriver::Untiled : public Drawing {
public:
    Untiled(const World& world, Renderer& renderer, const FrameOrder& order)
        : renderer_(renderer), run_(world, renderer) {
        run_.start(order.view, order.settings, order.stop);
    }
    bool advance() override { return run_.advance(); }
    [[nodiscard]] std::uint32_t samples() const override { return run_.samples(); }
    [[nodiscard]] std::uint32_t sampleTotal() const override { return run_.sampleTotal(); }
    [[nodiscard]] double share() const override { return run_.share(); }
    [[nodiscard]] const FramePlan& plan() const override { return run_.plan(); }
    [[nodiscard]] RenderStats stats() const override { return run_.stats(); }
    [[nodiscard]] double planMilliseconds() const override { return run_.planMilliseconds(); }
    [[nodiscard]] Image image() override { return renderer_.image(); }

private:
    Renderer& renderer_;
    FrameRun run_;
};

// Base class of Tiled, Summed and Separate, which draw a frame in parts. Plans the complete frame in its constructor.
class FrameDriver::Planned : public Drawing {
public:
    [[nodiscard]] std::uint32_t sampleTotal() const override {
        return static_cast<std::uint32_t>(plan_.samples.size());
    }
    [[nodiscard]] const FramePlan& plan() const override { return plan_; }
    [[nodiscard]] RenderStats stats() const override { return renderer_.stats(); }
    [[nodiscard]] double planMilliseconds() const override { return planMilliseconds_; }
    [[nodiscard]] Image image() override { return renderer_.image(); }

protected:
    // `automatic`: quality from which the number of samples is chosen; nullopt: the number is in `order.settings`.
    Planned(const World& world, Renderer& renderer, const FrameOrder& order, std::optional<Quality> automatic = {})
        : renderer_(renderer) {
        const Clock::time_point begin = Clock::now();
        plan_ = planOfTiles(world, order.view, order.settings, automatic);
        planMilliseconds_ = millisecondsSince(begin);
    }

    Renderer& renderer_;
    FramePlan plan_;

private:
    double planMilliseconds_ = 0;
};

class FrameDriver::Tiled : public Planned {
public:
    Tiled(const World& world, Renderer& renderer, FrameOrder order, const std::vector<Band>& bands)
        : Planned(world, renderer, order, order.stop.automatic),
          takeRows_(std::move(order.parts.takeRows)),
          bands_(bands),
          walk_(renderer, plan_, bands_, [this](const Tile& tile, Image&& pixels) { take(tile, std::move(pixels)); }) {
        if (!takeRows_) kept_ = Image(plan_.view.width, plan_.view.height, 4);
        for (const Band& band : bands_) rows_ += band.rows.end - band.rows.first;
    }

    bool advance() override { return walk_.advance(); }
    // Returns the number of samples drawn so far, averaged over all rows. 1e-6 is added so that a rounding error of
    // share(), the finished fraction, can't lower the result by one.
    [[nodiscard]] std::uint32_t samples() const override {
        return static_cast<std::uint32_t>(sampleTotal() * share() + 1e-6);
    }
    [[nodiscard]] double share() const override { return rows_ > 0 ? walk_.rowsDone() / rows_ : 1; }
    [[nodiscard]] RenderStats stats() const override {
        RenderStats stats = walk_.stats();
        stats.samples = sampleTotal();  // a finished tile has all samples of the frame
        return stats;
    }
    [[nodiscard]] Image image() override { return kept_; }
    [[nodiscard]] int tiles() const override { return walk_.tiles(); }

private:
    // Copies a finished tile into kept_. If the order has a row sink (FrameParts::takeRows), copies the tile into its
    // band (a row of tiles) instead, and passes each complete band to the sink.
    void take(const Tile& tile, Image&& pixels) {
        if (!takeRows_) return placeTile(kept_, 0, tile, pixels);
        const Band& band = bands_[band_];
        if (band.tiles.size() == 1) {
            rowsOfBand_ = std::move(pixels);
        } else {
            if (rowsOfBand_.empty()) rowsOfBand_ = Image(plan_.view.width, pixels.height, pixels.channels);
            placeTile(rowsOfBand_, band.rows.first, tile, pixels);
        }
        if (tile != band.tiles.back()) return;
        takeRows_(band.rows, std::exchange(rowsOfBand_, {}));
        ++band_;
    }

    RowSink takeRows_;
    std::vector<Band> bands_;
    std::size_t band_ = 0;  // index in bands_ of the band that is being drawn
    Image rowsOfBand_;
    Image kept_;  // complete frame; empty if finished rows go to a row sink
    int rows_ = 0;
    TileWalk walk_;
};

class FrameDriver::Summed : public Planned {
public:
    Summed(const World& world, Renderer& renderer, const FrameOrder& order) : Planned(world, renderer, order) {
        part_.frameSamples = static_cast<std::uint32_t>(plan_.samples.size());
        part_.range = {std::min(order.parts.samples->first, part_.frameSamples),
                       std::min(order.parts.samples->end, part_.frameSamples)};
        part_.width = plan_.view.width;
        part_.height = plan_.view.height;
        if (count() == 0) return;  // the frame has no samples in the requested range
        // With cat's eye and axial chromatic aberration, the weights of samples are normalized over all samples of the
        // frame, so partial sums cannot be merged.
        const Lens& lens = plan_.view.lens;
        if (plan_.usesLens && (lens.catEye > 0 || lens.axialChromaticAberration != 0))
            fail(
                "--sample-range cannot be combined with cat's-eye bokeh (--cat-eye) or axial chromatic aberration; "
                "render all samples at once");
        renderer.start(samplesOf(plan_, part_.range.first, count()));
    }

    bool advance() override {
        if (count() == 0) return false;
        const bool more = renderer_.advance();
        if (more && renderer_.samples() % blockSamples != 0) return true;
        part_.blocks.push_back(renderer_.blockSum().value());
        return more;
    }
    [[nodiscard]] std::uint32_t samples() const override { return count() == 0 ? 0 : renderer_.samples(); }
    [[nodiscard]] std::uint32_t sampleTotal() const override { return count(); }
    [[nodiscard]] double share() const override { return count() == 0 ? 1 : Drawing::share(); }
    [[nodiscard]] std::optional<FramePart> sums() override { return std::move(part_); }

private:
    [[nodiscard]] std::uint32_t count() const { return part_.range.end - part_.range.first; }

    FramePart part_;
};

class FrameDriver::Separate : public Planned {
public:
    Separate(const World& world, Renderer& renderer, const FrameOrder& order)
        : Planned(world, renderer, order), take_(order.parts.takeSample) {
        renderer_.start(samplesOf(plan_, 0, 1));
    }

    bool advance() override {
        if (samples_ == sampleTotal()) return false;
        if (samples_ > 0) renderer_.start(samplesOf(plan_, samples_, 1));
        while (renderer_.advance()) {
        }
        std::optional<Image> depth = renderer_.sampleDepth();
        if (!depth) fail("lens images require --method accumulation");
        take_(samples_, renderer_.image(), std::move(*depth));
        return ++samples_ < sampleTotal();
    }
    [[nodiscard]] std::uint32_t samples() const override { return samples_; }

private:
    SampleSink take_;
    std::uint32_t samples_ = 0;
};

DriverOptions driverOptions(const Request& request, std::filesystem::path shaderFolder, std::uint64_t keptPixelBytes) {
    return {chosenMethod(request),
            {request.memory, request.wave.value_or(0), request.layerFormat, request.threads},
            std::move(shaderFolder),
            keptPixelBytes};
}

FrameDriver::FrameDriver(const World& world, DriverOptions options) : world_(&world), options_(std::move(options)) {}

FrameDriver::~FrameDriver() = default;
FrameDriver::FrameDriver(FrameDriver&&) noexcept = default;
FrameDriver& FrameDriver::operator=(FrameDriver&&) noexcept = default;

void FrameDriver::makeRenderer() {
    RendererOptions options;
    options.layerFormat = options_.limits.layerFormat;
    options.wave = options_.limits.wave;
    options.threads = wantedThreads(options_.limits, *options_.method.method);
    options.waveBytes = waveBytesWithin(limit_, options.threads);
    options.pendingBytes = pendingBytesWithin(limit_);
    options.shaderFolder = options_.shaderFolder;
    options.settings = options_.method.settings;
    renderer_ = options_.method.method->make(*world_, options);
}

FrameDriver::Fit FrameDriver::fitOf(const FrameOrder& order) {
    return {order.view.width,
            order.view.height,
            order.settings.shadows,
            order.settings.positions,
            order.settings.layers,
            order.stop.choosesPositions,
            order.stop.given(),
            order.parts.samples.has_value(),
            static_cast<bool>(order.parts.takeRows),
            order.parts.shortDraws || order.stop.timeLimit,
            order.parts.untiledReason,
            order.parts.rows};
}

// Returns the max number of samples drawn together (in a wave) for a frame that must be able to stop soon. On a CPU,
// returns 1, because a sample may take long. On a GPU, returns a few, which take little time and keep the GPU busy.
// Returns 0 (no limit) for other frames.
std::uint32_t FrameDriver::shortWave(const FrameOrder& order) {
    if (!fitOf(order).shortDraws) return 0;
    return currentIsSoftware() ? 1 : 8;
}

// Chooses whether the frame is drawn untiled or in tiles, and how many lens samples are drawn together (in a wave).
void FrameDriver::fit(const FrameOrder& order) {
    const Method& method = *options_.method.method;
    const DrawLimits& limits = options_.limits;
    bands_.reset();
    crowded_ = false;
    limit_ = engine::memoryLimit(limits);
    if (!method.needsGl) {
        if (!renderer_) makeRenderer();
        return;
    }
    const Shadows shadows = order.settings.shadows;
    const bool mapsPossible = shadows == Shadows::on || (shadows == Shadows::automatic && hasGround(*world_->scene));
    const int axis = order.stop.choosesPositions ? 2 : positionsPerAxis(order.settings);
    const int width = order.view.width * axis;
    const int height = order.view.height * axis;
    if (!order.parts.rows && order.settings.layers.empty() && surelyFits(width, height, mapsPossible, limits, limit_)) {
        if (!renderer_) makeRenderer();
        return renderer_->setWave({.perWave = shortWave(order),
                                   .threads = threadsWithin(width, height, limit_, wantedThreads(limits, method))});
    }

    // Free the memory of the previous frame before the remaining memory is measured.
    renderer_.reset();
    giveBackFreedMemory();
    const FramePlan plan = planOfTiles(*world_, order.view, order.settings, order.stop.automatic);
    const bool tiles = mustDrawInTiles(*world_, plan, limits, method, limit_);
    if (tiles && order.stop.given())
        refuseTiles(plan, limit_, "--target-error and --time-limit need the whole image; give --samples");
    if (tiles && order.parts.samples)
        refuseTiles(plan, limit_, "--sample-range cannot draw in tiles; divide the image with --tile instead");
    if (tiles && !order.parts.untiledReason.empty()) refuseTiles(plan, limit_, order.parts.untiledReason);
    if (tiles || order.parts.rows)
        return fitTiles(order, plan, order.parts.rows.value_or(std::vector<RowRange>{{0, plan.view.height}}));
    TilingNeeds needs = needsBeforeUpload(*world_, plan, limits, limit_);
    makeRenderer();
    const std::uint32_t threads = threadsWithin(needs, wantedThreads(limits, method));
    reserveThreads(needs, threads);
    renderer_->setWave(
        {.samples = limits.memory ? waveWithin(needs) : 0, .perWave = shortWave(order), .threads = threads});
    if (!limits.memory) return;
    needs.keptBytes = pixelCount(needs.width, needs.height) * options_.keptPixelBytes;
    crowded_ = !fitsInOnePiece(needs);
}

void FrameDriver::fitTiles(const FrameOrder& order, const FramePlan& plan, const std::vector<RowRange>& rows) {
    makeRenderer();
    bands_.emplace();
    if (rows.empty()) return;
    TilingNeeds needs = measuredNeeds(*world_, plan, options_.limits, *renderer_, limit_);
    if (!order.parts.takeRows) needs.keptBytes = pixelCount(needs.width, needs.height) * options_.keptPixelBytes;
    const std::uint32_t threads = threadsWithin(needs, wantedThreads(options_.limits, *options_.method.method));
    reserveThreads(needs, threads);
    for (const RowRange& range : rows) {
        needs.rows = range;
        Tiling tiling = chosenTiling(needs);
        renderer_->setWave({.samples = tiling.wave, .threads = threads});
        bands_->insert(bands_->end(), tiling.bands.begin(), tiling.bands.end());
    }
}

namespace {

// Throws UsageError if a range of samples is requested from a method that does not sum samples in blocks.
void checkSampleRange(const FrameOrder& order, const Method& method) {
    if (order.parts.samples && !method.sumsBlocks)
        throw UsageError(
            fmt::format("method '{}' cannot add lens samples in blocks, which --sample-range requires", method.name));
}

// Throws UsageError if RenderSettings::layers contains data layers that the method does not support, or that cannot be
// written for this frame. Examples of such frames are partial sums, a part of the rows, and images of single lens
// samples. If any layers are requested, forbids tiles. `perSample`: Shutter::perSample.
void checkLayers(FrameOrder& order, const Method& method, bool perSample) {
    if (order.settings.layers.empty()) return;
    if (!method.drawsLayers)
        throw UsageError(
            fmt::format("method {} cannot draw the layers of --exr-layers; use auto or accumulation", method.name));
    if (order.parts.samples || order.parts.rows)
        throw UsageError("--exr-layers needs the whole image; leave out --sample-range and --tile");
    if (order.parts.takeSample) throw UsageError("--exr-layers cannot be combined with --lens-images");
    const auto& layers = order.settings.layers;
    if (std::ranges::find(layers, Layer::motion) != layers.end() && perSample)
        throw UsageError(
            "layer 'motion' cannot be written with --motion-segments exact; give a number or leave the option out");
    if (order.parts.untiledReason.empty()) order.parts.untiledReason = "--exr-layers needs the whole image";
}

}  // namespace

void FrameDriver::start(FrameOrder order) {
    checkSampleRange(order, *options_.method.method);
    checkLayers(order, *options_.method.method, world_->shutter.perSample);
    drawing_.reset();
    share_ = 0;
    Fit wanted = fitOf(order);
    if (fitted_ != wanted) {
        fitted_.reset();
        fit(order);
        fitted_ = std::move(wanted);
    }
    if (bands_)
        drawing_ = std::make_unique<Tiled>(*world_, *renderer_, std::move(order), *bands_);
    else if (order.parts.takeSample)
        drawing_ = std::make_unique<Separate>(*world_, *renderer_, order);
    else if (order.parts.samples)
        drawing_ = std::make_unique<Summed>(*world_, *renderer_, order);
    else
        drawing_ = std::make_unique<Untiled>(*world_, *renderer_, order);
}

bool FrameDriver::advance() {
    return drawing_->advance();
}

std::uint32_t FrameDriver::samples() const {
    return drawing_->samples();
}

std::uint32_t FrameDriver::sampleTotal() const {
    return drawing_->sampleTotal();
}

double FrameDriver::share() const {
    share_ = std::max(share_, drawing_->share());
    return share_;
}

const FramePlan& FrameDriver::plan() const {
    return drawing_->plan();
}

RenderStats FrameDriver::stats() const {
    return drawing_->stats();
}

double FrameDriver::planMilliseconds() const {
    return drawing_->planMilliseconds();
}

int FrameDriver::tiles() const {
    return drawing_->tiles();
}

MethodUse FrameDriver::method() const {
    if (inTiles() && options_.method.method->name == automaticMethod) return parseMethodUse("accumulation");
    return drawnMethod(options_.method, plan());
}

bool FrameDriver::inTiles() const {
    return bands_.has_value();
}

Image FrameDriver::image() {
    return drawing_->image();
}

std::optional<LayerImages> FrameDriver::layerImages() {
    return renderer_->layerImages();
}

FramePart FrameDriver::sums() {
    std::optional<FramePart> part = drawing_->sums();
    if (!part) fail("the frame was not started for a range of its samples");
    return std::move(*part);
}

FramePlan planOfTiles(const World& world, const View& view, RenderSettings settings, std::optional<Quality> automatic) {
    if (!automatic) return planFrame(world, view, settings);
    settings.sampleCount = blockSamples;
    settings.sampleCount = samplesForBlur(planFrame(world, view, settings), *automatic);
    return planFrame(world, view, settings);
}

}  // namespace defocus::engine
