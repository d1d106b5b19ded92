#include "frame/driver/scene_driver.h"

#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "frame/report/layer_file.h"
#include "frame/report/picture_warnings.h"
#include "frame/report/plan_warnings.h"
#include "frame/setup/exposure.h"
#include "frame/setup/levels.h"
#include "frame/setup/settings_hash.h"
#include "render/aov/aov.h"
#include "render/aov/work.h"
#include "scene/ground.h"

namespace defocus::engine {

namespace {

// Bytes per pixel of RGBA float images in main memory: the driver's image, the returned image and its encoded copy.
constexpr std::uint64_t keptPixelBytes = 3 * 16;

bool sameScene(const Request& a, const Request& b) {
    return a.scene == b.scene && a.variant == b.variant &&
           (!a.scene.empty() || (a.fishCount == b.fishCount && a.trianglesPerFish == b.trianglesPerFish));
}

bool sameSurroundings(const Request& a, const Request& b) {
    return a.environment == b.environment && a.environmentRotation == b.environmentRotation &&
           a.background == b.background;
}

// Returns whether a single FrameDriver can draw both requests.
bool sameDriver(const Request& a, const Request& b) {
    return chosenMethod(a).text() == chosenMethod(b).text() && a.layerFormat == b.layerFormat && a.wave == b.wave &&
           a.threads == b.threads && a.memory == b.memory && sameSurroundings(a, b);
}

std::size_t pyramidKind(const RenderSettings& settings) {
    if (settings.lod == LodMode::off) return 0;
    return 1 + static_cast<std::size_t>(settings.levelVertices);
}

// Returns a note if a frame in tiles may take a different number of samples than an untiled frame; otherwise empty.
std::vector<std::string> tiledSamplesNote(const FramePlan& plan) {
    if (!plan.usesLens) return {};
    return {
        fmt::format("the image is drawn in tiles with {} lens samples, a number estimated from the blur; without "
                    "tiles, the number may differ; give --samples for a fixed number",
                    plan.samples.size())};
}

}  // namespace

SceneDriver::SceneDriver(std::shared_ptr<const Scene> scene, const Request& request, std::filesystem::path shaderFolder,
                         const Progress& progress)
    : named_(scene == nullptr), shaderFolder_(std::move(shaderFolder)), first_(request), request_(request) {
    const Clock::time_point begin = Clock::now();
    checkRequest(request);
    scene_.emplace(named_ ? SharedScene(request, progress) : SharedScene(std::move(scene), request));
    frame_ = placeFrame(scene_->of(request), request);
    chooseLevels(frame_, request);
    loadMilliseconds_ = millisecondsSince(begin);
    {
        const CurrentContextKeeper callers;
        context_ = createHeadlessContext();
    }
    addPyramids(frame_, progress);
    pyramidMilliseconds_ = frame_.pyramidMilliseconds;
}

SceneDriver::~SceneDriver() {
    try {
        const InContext use(*context_);
        driver_.reset();
        context_.reset();
    } catch (const Error&) {  // another thread uses the context: leak its resources until the process ends
        if (driver_) static_cast<void>(new FrameDriver(std::move(*driver_)));
        static_cast<void>(context_.release());
    }
}

// Moves the pyramids of the previous frame to `next`. If `next` needs pyramids of another `kind` (see pyramidKinds),
// stores the previous pyramids for later frames instead. Doesn't throw.
void SceneDriver::handOnPyramids(PreparedFrame& next, std::size_t kind) {
    if (kind == pyramidKind(frame_.settings)) {
        next.world.pyramids = std::move(frame_.world.pyramids);
        next.pyramidsLoaded = frame_.pyramidsLoaded;
        next.cacheFailure = std::move(frame_.cacheFailure);
        return;
    }
    if (next.world.pyramids.empty()) next.world.pyramids = std::move(otherPyramids_[kind]);
    otherPyramids_[kind].clear();
    otherPyramids_[pyramidKind(frame_.settings)] = std::move(frame_.world.pyramids);
}

void SceneDriver::start(const Request& request, const FrameParts& parts, const Progress& progress) {
    // Before the previous frame is replaced, run all steps that an invalid request can cause to fail.
    checkRequest(request);
    if (named_ && !sameScene(request, first_))
        throw UsageError("the request names another scene; create a SceneRenderer for it");
    const Environment* known = sameSurroundings(request, request_) ? &frame_.world.environment : nullptr;
    PreparedFrame next = placeFrame(scene_->of(request), request, known);
    chooseLevels(next, request);
    const std::size_t kind = pyramidKind(next.settings);
    const bool sameGround = hasGround(*next.scene) == hasGround(*frame_.scene);
    const bool samePyramids = kind == pyramidKind(frame_.settings) && sameGround;
    const bool same = samePyramids && sameDriver(request, request_);
    if (!samePyramids && (!sameGround || otherPyramids_[kind].empty())) {
        addPyramids(next, progress);
        pyramidMilliseconds_ += next.pyramidMilliseconds;
    }
    Request asked = request;
    const InContext use(*context_);

    // All checks of the request have passed: replace the previous frame.
    if (!same) driver_.reset();
    if (sameGround)
        handOnPyramids(next, kind);
    else  // adding or removing the ground changes the meshes, so stored pyramids don't match
        otherPyramids_ = {};
    next.loadMilliseconds = loadMilliseconds_;
    next.pyramidMilliseconds = pyramidMilliseconds_;
    frame_ = std::move(next);
    request_ = std::move(asked);
    try {
        if (!driver_) driver_.emplace(frame_.world, driverOptions(request_, shaderFolder_, keptPixelBytes));
        FrameOrder order{.view = frame_.view,
                         .settings = frame_.settings,
                         .stop = stopSettings(request_),
                         .samples = parts.samples,
                         .rows = parts.rows,
                         .takeRows = parts.takeRows,
                         .untiledReason = parts.untiledReason,
                         .shortDraws = parts.shortDraws};
        if (parts.lensImages) {
            order.view = withMargin(frame_.view, parts.lensImages->margin);
            order.settings.refocus = parts.lensImages->range;
            order.takeSample = parts.lensImages->take;
        }
        driver_->start(std::move(order));
    } catch (...) {
        driver_.reset();
        throw;
    }
}

bool SceneDriver::advance() {
    FrameDriver& driver = this->driver();
    const InContext use(*context_);
    return driver.advance();
}

FrameDriver& SceneDriver::driver() {
    if (!driver_) fail("no frame has been started; call start() first");
    return *driver_;
}

const FrameDriver& SceneDriver::driver() const {
    if (!driver_) fail("no frame has been started; call start() first");
    return *driver_;
}

Image SceneDriver::image() {
    if (driver().samples() == 0) fail("the image has no samples yet; call advance() first");
    const InContext use(*context_);
    return driver_->image();
}

AovImages SceneDriver::aovs() {
    if (driver().inTiles())
        fail(
            "AOVs need the whole image, but the image does not fit into memory and is drawn in tiles; raise --memory "
            "or reduce --size");
    const InContext use(*context_);
    return renderAovs(frame_.world, driver_->plan(), shaderFolder_);
}

std::optional<LayerImages> SceneDriver::layerImages() {
    FrameDriver& driver = this->driver();
    const InContext use(*context_);
    return driver.layerImages();
}

Image SceneDriver::work() {
    const FramePlan& plan = driver().plan();
    const InContext use(*context_);
    return renderWork(frame_.world, plan, shaderFolder_);
}

std::vector<std::string> SceneDriver::warnings() const {
    std::vector<std::string> lines = requestWarnings(request_, frame_);
    const auto add = [&](const std::vector<std::string>& more) { lines.insert(lines.end(), more.begin(), more.end()); };
    // Warnings about the plan need the final number of samples. If that number isn't fixed, use the number drawn so
    // far.
    const StopSettings stop = stopSettings(request_);
    const bool counted = !stop.given() && !stop.automatic;
    if (driver_ && (counted || driver_->samples() > 0)) {
        add(planWarnings(driver_->plan(), driver_->method(), counted ? 0 : driver_->samples()));
        if (driver_->inTiles() && stop.automatic) add(tiledSamplesNote(driver_->plan()));
    }
    if (request_.threads.value_or(1) > 1 && !drawsInThreads(context_->device(), context_->driver()))
        lines.push_back(
            fmt::format("--threads {} has no effect: OpenGL contexts of {} ({}) cannot draw in several threads; use "
                        "Mesa 25.0 or later",
                        *request_.threads, context_->device(), context_->driver()));
    add(clipped_);
    return lines;
}

std::string SceneDriver::settingsHash() const {
    return engine::settingsHash(filmSettings(frame_, request_, shaderFolder_), momentOf(frame_, request_));
}

WriteOptions SceneDriver::writeOptions() {
    const InContext use(*context_);
    const bool meters = metersExposure(request_, *frame_.scene, frame_.view.lens);
    const double exposure = meters && metered_
                                ? *metered_
                                : chosenExposure(request_, frame_.world, frame_.view, frame_.settings, shaderFolder_);
    if (meters) metered_ = exposure;
    return {request_.toneMap, exposure};
}

RenderReport SceneDriver::report(std::string command, double milliseconds) {
    const double exposure = writeOptions().exposure;
    const InContext use(*context_);
    const FrameDriver& driver = this->driver();
    return {.options = request_,
            .method = driver.method().text(),
            .frame = frame_,
            .plan = driver.plan(),
            .stats = driver.stats(),
            .softwareDriver = context_->software(),
            .totalMilliseconds = milliseconds,
            .exposure = exposure,
            .command = std::move(command),
            .memoryLimit = driver.memoryLimit(),
            .tiles = driver.tiles()};
}

RenderStatistics SceneDriver::statistics() const {
    RenderStatistics statistics;
    statistics.loadMilliseconds = loadMilliseconds_;
    statistics.pyramidMilliseconds = pyramidMilliseconds_;
    statistics.device = context_->device();
    if (!driver_) return statistics;
    const InContext use(*context_);
    const RenderStats stats = driver_->stats();
    statistics.samples = driver_->samples();
    statistics.positions = driver_->plan().settings.positions;
    statistics.setupMilliseconds = stats.setupMilliseconds;
    statistics.renderMilliseconds = stats.renderMilliseconds;
    statistics.trianglesDrawn = stats.trianglesDrawn;
    statistics.trianglesAtFullDetail = driver_->plan().trianglesAtFullDetail;
    statistics.stopped = stats.stopped;
    statistics.estimatedError = stats.estimatedError;
    statistics.gpuBytes = stats.peakBytes;
    return statistics;
}

Metadata SceneDriver::metadata() {
    return renderMetadata(report());
}

void SceneDriver::write(const std::filesystem::path& path, const ImageView& image) {
    const WriteOptions options = writeOptions();
    const std::optional<LayerImages> layers = isExr(path) ? layerImages() : std::nullopt;
    writePicture(path, image, layers ? &*layers : nullptr, *frame_.scene, frame_.world.pose, request_.exrNames,
                 metadata(), options);
    if (!isExr(path)) clipped_ = clippingWarnings(image, options);
}

}  // namespace defocus::engine
