#include <array>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/memory_limits.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "defocus/renderer.h"
#include "frame/exposure.h"
#include "frame/memory_budget.h"
#include "frame/picture_warnings.h"
#include "frame/plan_warnings.h"
#include "frame/prepared_frame.h"
#include "frame/render_report.h"
#include "frame/scene_scale.h"
#include "frame/tiled_frame.h"
#include "frame/tiled_picture.h"
#include "frame/unused_settings.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "plan/plan_text.h"
#include "render/aov/aov.h"
#include "render/frame_run.h"
#include "render/layer_format.h"
#include "scene/ground.h"

namespace defocus {

namespace {

bool sameScene(const Request& a, const Request& b) {
    return a.scene == b.scene &&
           (!a.scene.empty() || (a.fishCount == b.fishCount && a.trianglesPerFish == b.trianglesPerFish));
}

bool sameSurroundings(const Request& a, const Request& b) {
    return a.environment == b.environment && a.environmentRotation == b.environmentRotation &&
           a.background == b.background && a.backgroundColor == b.backgroundColor;
}

// Would both be drawn with the same resources?
bool sameRenderer(const Request& a, const Request& b) {
    return chosenMethod(a).text() == chosenMethod(b).text() && a.layerFormat == b.layerFormat && a.wave == b.wave &&
           a.memory == b.memory && sameSurroundings(a, b);
}

// The kinds of pyramids that a request may need: full detail alone, or levels of any sort of vertices.
constexpr std::size_t pyramidKinds = 4;
std::size_t pyramidKind(const Request& request) {
    if (request.settings.lod == LodMode::off) return 0;
    return 1 + static_cast<std::size_t>(request.settings.levelVertices);
}

// Of a picture that is drawn in tiles, bytes a pixel in main memory: as it is kept, handed out, and encoded.
constexpr std::uint64_t keptPixelBytes = 16 + 16 + 16;

// Whether any frame of this size fits into the memory in one piece: there is no need to look at its plan.
bool surelyFits(const Request& request, std::uint64_t limit) {
    const std::uint64_t pixel = 2 * layerPixelBytes(LayerFormat::rgba32f) + sumPixelBytes + wholePixelBytes;
    const std::uint64_t pixels = std::uint64_t(request.width) * std::uint64_t(request.height);
    const std::uint64_t held = residentMemory();
    const Shadows shadows = request.settings.shadows;
    const bool maps = shadows == Shadows::on || (shadows == Shadows::automatic && request.ground);
    const bool oneCell = cellsOf(request.width, request.height).size() == 1;
    return !request.memory && oneCell && !maps && limit > held && pixels * pixel <= limit - held;
}

}  // namespace

class SceneRenderer::State {
public:
    // `handle`: null where the request names the scene.
    State(SceneHandle handle, const Request& request, const Progress& progress);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    void start(const Request& request, const Progress& progress);
    bool advance();
    [[nodiscard]] std::uint32_t samples() const {
        return tiled_ ? tiled_->samples() : renderer_ ? renderer_->samples() : 0;
    }
    [[nodiscard]] std::uint32_t sampleTotal() const {
        return tiled_ ? tiled_->sampleTotal() : run_ ? run_->sampleTotal() : 0;
    }
    [[nodiscard]] Image image();
    [[nodiscard]] RenderStatistics statistics() const;
    [[nodiscard]] Aovs aovs();
    [[nodiscard]] std::string planText() const;
    void write(const std::filesystem::path& path, const ImageView& image);
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] const Request& first() const { return first_; }
    [[nodiscard]] SceneHandle scene() const { return scene_; }

private:
    // The library's context is current as long as it lives, and then the caller's again.
    struct InContext {
        explicit InContext(GlContext& context) { context.makeCurrent(); }
        CurrentContextKeeper callers;
    };

    [[nodiscard]] std::shared_ptr<Scene> scaledScene(const Request& request) const;
    void checkStarted() const;
    void handOnPyramids(PreparedFrame& next, std::size_t kind);
    void makeRenderer();
    void dropRenderer();
    void startTiles(bool asBefore);
    [[nodiscard]] const FramePlan& plan() const { return tiled_ ? tiled_->plan : run_->plan(); }
    [[nodiscard]] RenderStats stats() const { return tiled_ ? tiled_->stats() : run_->stats(); }

    bool named_;  // the scene, by the request
    Request first_, request_;
    std::shared_ptr<Scene> scene_;                                  // shared with others and never written to
    PreparedFrame frame_;                                           // of request_; the renderer refers to its world
    std::array<std::vector<Pyramid>, pyramidKinds> otherPyramids_;  // that frames before had; the frame's own is empty
    double loadMilliseconds_ = 0;
    double pyramidMilliseconds_ = 0;
    std::optional<double> metered_;     // EV, by the first image that was written and needed it
    std::vector<std::string> clipped_;  // what is to be said of the 8-bit picture that was written last
    std::unique_ptr<GlContext> context_;
    std::unique_ptr<Renderer> renderer_;   // of the frame that was started; null: none was
    std::optional<FrameRun> run_;          // with the renderer
    std::unique_ptr<TiledPicture> tiled_;  // of a frame that doesn't fit into memory in one piece
};

// Faults first: values, scene, lens, device; only then the long work.
SceneRenderer::State::State(SceneHandle handle, const Request& request, const Progress& progress)
    : named_(handle == nullptr), first_(request), request_(request) {
    const Clock::time_point begin = Clock::now();
    checkRequest(request);
    scene_ = named_ ? std::make_shared<Scene>(loadScene(request, progress))
                    : std::const_pointer_cast<Scene>(std::move(handle));
    if (named_) setScale(request, *scene_);
    frame_ = placeFrame(scaledScene(request), request);
    loadMilliseconds_ = millisecondsSince(begin);
    {
        const CurrentContextKeeper callers;
        context_ = createHeadlessContext();
    }
    addPyramids(frame_, progress);
    pyramidMilliseconds_ = frame_.pyramidMilliseconds;
}

SceneRenderer::State::~State() {
    try {
        const InContext use(*context_);
        renderer_.reset();
        context_.reset();
    } catch (const Error&) {  // another thread has the context: its resources go with the process
        static_cast<void>(renderer_.release());
        static_cast<void>(context_.release());
    }
}

// The scene with the units and the blur of nodes that the request gives: a copy, as others may render the scene too.
std::shared_ptr<Scene> SceneRenderer::State::scaledScene(const Request& request) const {
    const double metresPerUnit = request.metresPerUnit.value_or(scene_->metresPerUnit);
    if (request.nodeBlur.empty() && metresPerUnit == scene_->metresPerUnit && !request.ground) return scene_;
    if (frame_.scene && frame_.scene != scene_ && request.nodeBlur == request_.nodeBlur &&
        request.ground == request_.ground && metresPerUnit == frame_.scene->metresPerUnit)
        return frame_.scene;
    auto scaled = std::make_shared<Scene>(*scene_);
    setNodeBlur(request, *scaled);
    scaled->metresPerUnit = metresPerUnit;
    setGround(request, *scaled);
    return scaled;
}

void SceneRenderer::State::checkStarted() const {
    if (!renderer_) fail("no frame was started; call start() first");
}

// The frame before hands its pyramids on, or keeps them for later where `next` needs another kind. Nothing throws.
void SceneRenderer::State::handOnPyramids(PreparedFrame& next, std::size_t kind) {
    if (kind == pyramidKind(request_)) {
        next.world.pyramids = std::move(frame_.world.pyramids);
        next.pyramidsLoaded = frame_.pyramidsLoaded;
        next.cacheFailure = std::move(frame_.cacheFailure);
        return;
    }
    if (next.world.pyramids.empty()) next.world.pyramids = std::move(otherPyramids_[kind]);
    otherPyramids_[kind].clear();
    otherPyramids_[pyramidKind(request_)] = std::move(frame_.world.pyramids);
}

void SceneRenderer::State::makeRenderer() {
    const MethodUse use = chosenMethod(request_);
    RendererOptions options;
    options.layerFormat = request_.layerFormat;
    options.wave = request_.wave;
    options.waveBytes = waveBytesWithin(memoryLimit(request_));
    options.settings = use.settings;
    renderer_ = use.method->make(frame_.world, options);
    run_.emplace(frame_.world, *renderer_);
}

void SceneRenderer::State::dropRenderer() {
    tiled_.reset();
    run_.reset();
    renderer_.reset();
}

// Sees to a renderer, and begins to draw the frame in tiles where it doesn't fit into memory in one piece. `asBefore`:
// as the frame before was drawn, whose layers and sums are those of this one.
void SceneRenderer::State::startTiles(bool asBefore) {
    std::vector<Band> bands;
    if (asBefore) {
        if (!tiled_) return;
        bands = std::move(tiled_->bands);
        tiled_.reset();
    } else {
        const std::uint64_t limit = memoryLimit(request_);
        tiled_.reset();
        if (surelyFits(request_, limit)) {
            if (!renderer_) makeRenderer();
            return renderer_->setWave(0);
        }
        // What the frame before holds of memory goes before it is looked at.
        dropRenderer();
        giveBackFreedMemory();
        makeRenderer();
        const FramePlan plan = planFrame(frame_.world, frame_.view, frame_.settings);
        if (!mustDrawInTiles(frame_.world, plan, request_, *chosenMethod(request_).method, limit)) return;
        TilingNeeds needs = measuredNeeds(frame_.world, plan, request_, *renderer_, limit);
        needs.keptBytes = std::uint64_t(request_.width) * std::uint64_t(request_.height) * keptPixelBytes;
        Tiling tiling = chosenTiling(needs);
        renderer_->setWave(tiling.wave);
        bands = std::move(tiling.bands);
    }
    tiled_ = std::make_unique<TiledPicture>(
        *renderer_, planOfTiles(frame_.world, frame_.view, runSettings(frame_, request_)), std::move(bands));
}

void SceneRenderer::State::start(const Request& request, const Progress& progress) {
    // What may fail by the request leaves the frame before as it is.
    checkRequest(request);
    if (named_ && !sameScene(request, first_))
        throw UsageError("the request is of another scene; make a SceneRenderer of its own for it");
    const Environment* known = sameSurroundings(request, request_) ? &frame_.world.environment : nullptr;
    PreparedFrame next = placeFrame(scaledScene(request), request, known);
    const std::size_t kind = pyramidKind(request);
    const bool sameGround = hasGround(*next.scene) == hasGround(*frame_.scene);
    const bool samePyramids = kind == pyramidKind(request_) && sameGround;
    const bool same = samePyramids && sameRenderer(request, request_);
    if (!samePyramids && (!sameGround || otherPyramids_[kind].empty())) {
        addPyramids(next, progress);
        pyramidMilliseconds_ += next.pyramidMilliseconds;
    }
    const bool sameNeeds = same && renderer_ && request.width == request_.width && request.height == request_.height &&
                           request.settings.shadows == request_.settings.shadows &&
                           request.stop.given() == request_.stop.given();
    Request asked = request;
    const InContext use(*context_);

    // From here on the frame is the request's.
    if (!same) dropRenderer();
    if (sameGround)
        handOnPyramids(next, kind);
    else  // they are of a scene with one mesh more or less
        otherPyramids_ = {};
    frame_ = std::move(next);
    request_ = std::move(asked);
    try {
        startTiles(sameNeeds);
        if (tiled_) return;
        run_->start(frame_.view, runSettings(frame_, request_), request_.stop);
    } catch (...) {
        dropRenderer();
        throw;
    }
}

bool SceneRenderer::State::advance() {
    checkStarted();
    const InContext use(*context_);
    return tiled_ ? tiled_->walk.advance() : run_->advance();
}

Image SceneRenderer::State::image() {
    checkStarted();
    if (samples() == 0) fail("the image has no sample yet; call advance() first");
    const InContext use(*context_);
    return tiled_ ? tiled_->image : renderer_->image();
}

RenderStatistics SceneRenderer::State::statistics() const {
    RenderStatistics statistics;
    statistics.loadMilliseconds = loadMilliseconds_;
    statistics.pyramidMilliseconds = pyramidMilliseconds_;
    statistics.device = context_->device();
    if (!renderer_) return statistics;
    const InContext use(*context_);
    const RenderStats stats = this->stats();
    statistics.samples = stats.samples;
    statistics.setupMilliseconds = stats.setupMilliseconds;
    statistics.renderMilliseconds = stats.renderMilliseconds;
    statistics.trianglesDrawn = stats.trianglesDrawn;
    statistics.trianglesAtFullDetail = plan().trianglesAtFullDetail;
    statistics.stopped = stats.stopped;
    statistics.estimatedError = stats.estimatedError;
    statistics.gpuBytes = stats.peakBytes;
    return statistics;
}

Aovs SceneRenderer::State::aovs() {
    checkStarted();
    if (tiled_) fail("the image is drawn in tiles, as it doesn't fit into memory, and AOVs show the whole image");
    const InContext use(*context_);
    AovImages images = renderAovs(frame_.world, plan());
    return {std::move(images.depth), std::move(images.coc), std::move(images.level)};
}

std::vector<std::string> SceneRenderer::State::warnings() const {
    std::vector<std::string> lines = frameWarnings(frame_);
    const auto add = [&](const std::vector<std::string>& more) { lines.insert(lines.end(), more.begin(), more.end()); };
    add(ignoredWarnings(*frame_.scene));
    add(unusedSettings(request_, *frame_.scene, frame_.view.lens));
    if (renderer_) add(planWarnings(plan(), chosenMethod(request_)));
    if (tiled_) add(tiledSamplesNote(plan(), isAutomatic(request_)));
    add(clipped_);
    return lines;
}

std::string SceneRenderer::State::planText() const {
    checkStarted();
    return defocus::planJson(plan());
}

void SceneRenderer::State::write(const std::filesystem::path& path, const ImageView& image) {
    checkStarted();
    const InContext use(*context_);
    // The images of a film are metered once.
    const bool meters = metersExposure(request_, *frame_.scene, frame_.view.lens);
    const double exposure =
        meters && metered_ ? *metered_ : chosenExposure(request_, frame_.world, frame_.view, frame_.settings);
    if (meters) metered_ = exposure;
    const RenderReport report{request_, chosenMethod(request_).text(), frame_, plan(),
                              stats(),  context_->software(),          0,      exposure};
    const WriteOptions options{request_.toneMap, exposure};
    writeImage(path, image, renderMetadata(report), options);
    const std::string ending = path.extension().string();
    if (ending != ".exr" && ending != ".EXR") clipped_ = clippingWarnings(image, options);
}

// ---- the public class -------------------------------------------------------------------------------------------

SceneRenderer::SceneRenderer(const Request& request, const Progress& progress)
    : state_(std::make_unique<State>(nullptr, request, progress)) {}

SceneRenderer::SceneRenderer(SceneHandle scene, const Request& request, const Progress& progress) {
    if (!scene) throw UsageError("no scene is open; loadScene() or schoolOfFish() opens one");
    state_ = std::make_unique<State>(std::move(scene), request, progress);
}

SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

void SceneRenderer::start() {
    state_->start(state_->first(), {});
}

void SceneRenderer::start(const Request& request) {
    state_->start(request, {});
}

bool SceneRenderer::advance() {
    return state_->advance();
}

std::uint32_t SceneRenderer::samples() const {
    return state_->samples();
}

std::uint32_t SceneRenderer::sampleTotal() const {
    return state_->sampleTotal();
}

Image SceneRenderer::image() {
    return state_->image();
}

RenderStatistics SceneRenderer::statistics() const {
    return state_->statistics();
}

Image SceneRenderer::render(const Progress& progress, std::stop_token stop) {
    return render(state_->first(), progress, std::move(stop));
}

// At least one sample is drawn, so that there is an image.
Image SceneRenderer::render(const Request& request, const Progress& progress, std::stop_token stop) {
    state_->start(request, progress);
    report(progress, "samples", 0, sampleTotal());
    bool more = true;
    do {
        more = advance();
        report(progress, "samples", samples(), sampleTotal());
    } while (more && (!stop.stop_requested() || samples() == 0));
    return image();
}

Aovs SceneRenderer::aovs() {
    return state_->aovs();
}

std::string SceneRenderer::planJson() const {
    return state_->planText();
}

void SceneRenderer::write(const std::filesystem::path& path, const ImageView& image) const {
    state_->write(path, image);
}

std::vector<std::string> SceneRenderer::warnings() const {
    return state_->warnings();
}

SceneHandle SceneRenderer::scene() const {
    return state_->scene();
}

}  // namespace defocus
