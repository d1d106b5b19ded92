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
    loadMilliseconds_ = frame_.loadMilliseconds = millisecondsSince(begin);
}

SceneDriver::SceneDriver(PreparedFrame frame, const Request& request, std::filesystem::path shaderFolder)
    : shaderFolder_(std::move(shaderFolder)),
      first_(request),
      request_(request),
      frame_(std::move(frame)),
      loadMilliseconds_(frame_.loadMilliseconds),
      pyramidMilliseconds_(frame_.pyramidMilliseconds) {}

SceneDriver::~SceneDriver() {
    try {
        const InContext use = inContext();
        driver_.reset();
        context_.reset();
    } catch (const Error&) {  // another thread uses the context: leak its resources until the process ends
        if (driver_) static_cast<void>(new FrameDriver(std::move(*driver_)));
        static_cast<void>(context_.release());
    }
}

void SceneDriver::prepare(const Progress& progress) {
    chooseLevels(frame_, request_);
    openContext();
    buildPyramids(progress);
}

void SceneDriver::openContext() {
    if (context_) return;
    const CurrentContextKeeper callers;
    context_ = createHeadlessContext();
}

void SceneDriver::buildPyramids(const Progress& progress) {
    givePyramids(frame_, progress);
}

void SceneDriver::makeCurrent() {
    if (context_) context_->makeCurrent();
}

// Sets the pyramids of `frame`: those of an earlier frame, or else new ones.
void SceneDriver::givePyramids(PreparedFrame& frame, const Progress& progress) {
    if (hasGround(*frame.scene) != builtGround_) built_ = {};  // the ground adds a mesh, or changes one
    builtGround_ = hasGround(*frame.scene);
    std::optional<Built>& built = built_[pyramidKind(frame.settings)];
    if (!built) {
        addPyramids(frame, progress);
        pyramidMilliseconds_ += frame.pyramidMilliseconds;
        built = {frame.world.pyramids, frame.pyramidsLoaded, frame.cacheFailure};
    }
    frame.world.pyramids = built->pyramids;
    frame.pyramidsLoaded = built->loaded;
    frame.cacheFailure = built->cacheFailure;
    frame.loadMilliseconds = loadMilliseconds_;
    frame.pyramidMilliseconds = pyramidMilliseconds_;
}

void SceneDriver::start(const Request& request, const FrameParts& parts, const Progress& progress) {
    // Before the previous frame is replaced, run all steps that an invalid request can cause to fail.
    checkRequest(request);
    if (named_ && !sameScene(request, first_))
        throw UsageError("the request names another scene; create a SceneRenderer for it");
    const Environment* known = sameSurroundings(request, request_) ? &frame_.world.environment : nullptr;
    PreparedFrame next = placeFrame(scene_->of(request), request, known);
    chooseLevels(next, request);
    openContext();
    givePyramids(next, progress);
    Request asked = request;
    const InContext use = inContext();

    // All checks of the request have passed: replace the previous frame.
    if (next.world.pyramids != frame_.world.pyramids) resetDriver();
    replaceRequest(std::move(asked));
    frame_ = std::move(next);
    start(parts);
}

void SceneDriver::pose(Request request, const FrameMoment& moment) {
    request.time = moment.time;
    request.seed = moment.settings.seed;
    replaceRequest(std::move(request));
    applyMoment(moment, frame_.world);
    frame_.view = moment.view;
    frame_.settings = moment.settings;
}

void SceneDriver::start(const FrameParts& parts) {
    const InContext use = inContext();
    try {
        if (!driver_) driver_.emplace(frame_.world, driverOptions(request_, shaderFolder_, keptPixelBytes));
        driver_->start({frame_.view, frame_.settings, stopSettings(request_), parts});
    } catch (...) {
        driver_.reset();
        throw;
    }
}

void SceneDriver::resetDriver() {
    const InContext use = inContext();
    driver_.reset();
}

// Sets the request of the next frame. Keeps the FrameDriver if it can draw that frame, too.
void SceneDriver::replaceRequest(Request request) {
    if (!sameDriver(request, request_)) resetDriver();
    request_ = std::move(request);
}

bool SceneDriver::advance() {
    FrameDriver& driver = this->driver();
    const InContext use = inContext();
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

RenderStats SceneDriver::stats() const {
    const FrameDriver& driver = this->driver();
    const InContext use = inContext();
    return driver.stats();
}

Image SceneDriver::image() {
    if (driver().samples() == 0) fail("the image has no samples yet; call advance() first");
    const InContext use = inContext();
    return driver_->image();
}

AovImages SceneDriver::aovs() {
    if (driver().inTiles())
        fail(
            "AOVs need the whole image, but the image does not fit into memory and is drawn in tiles; raise --memory "
            "or reduce --size");
    const InContext use = inContext();
    return renderAovs(frame_.world, driver_->plan(), shaderFolder_);
}

std::optional<LayerImages> SceneDriver::layerImages() {
    FrameDriver& driver = this->driver();
    const InContext use = inContext();
    return driver.layerImages();
}

Image SceneDriver::work() {
    const FramePlan& plan = driver().plan();
    const InContext use = inContext();
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
    if (context_ && request_.threads.value_or(1) > 1 && !drawsInThreads(context_->device(), context_->driver()))
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
    const InContext use = inContext();
    const bool meters = metersExposure(request_, *frame_.scene, frame_.view.lens);
    const double exposure = meters && metered_
                                ? *metered_
                                : chosenExposure(request_, frame_.world, frame_.view, frame_.settings, shaderFolder_);
    if (meters) metered_ = exposure;
    return {request_.toneMap, exposure};
}

RenderReport SceneDriver::report(const FramePlan& plan, const RenderStats& stats) {
    return {.options = request_,
            .method = driver().method().text(),
            .frame = frame_,
            .plan = plan,
            .stats = stats,
            .softwareDriver = context_ && context_->software(),
            .exposure = writeOptions().exposure,
            .memoryLimit = driver().memoryLimit(),
            .tiles = driver().tiles()};
}

RenderReport SceneDriver::report(std::string command, double milliseconds) {
    RenderReport report = this->report(driver().plan(), stats());
    report.command = std::move(command);
    report.totalMilliseconds = milliseconds;
    return report;
}

RenderStatistics SceneDriver::statistics() const {
    RenderStatistics statistics;
    statistics.loadMilliseconds = loadMilliseconds_;
    statistics.pyramidMilliseconds = pyramidMilliseconds_;
    if (context_) statistics.device = context_->device();
    if (!driver_) return statistics;
    const RenderStats stats = this->stats();
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
