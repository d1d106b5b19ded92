#include "view/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lens/lens_fields.h"

namespace defocus {

namespace {

using namespace std::chrono_literals;

constexpr auto settling = 120ms;               // without change, before an image begins to grow
constexpr std::uint32_t firstShownSample = 4;  // of a growing image: fewer are worse than the frame before
constexpr double nextShown = 1.08;             // times the samples that were shown last: less can't be seen
constexpr double softwareGrowth = 60;          // ms a frame that a still image takes at least
constexpr auto psnrEvery = 700ms;

// All that the image depends on, as numbers.
std::vector<double> imageKey(const PictureRequest& request) {
    const View& view = request.view;
    const RenderSettings& settings = request.settings;
    std::vector<double> key = {static_cast<double>(view.width),
                               static_cast<double>(view.height),
                               view.nearPlane,
                               static_cast<double>(request.poseVersion),
                               static_cast<double>(settings.seed),
                               static_cast<double>(settings.sequence),
                               settings.cocTolerance,
                               static_cast<double>(settings.metric),
                               static_cast<double>(settings.lodCocAtCentre),
                               static_cast<double>(settings.levelVertices),
                               static_cast<double>(settings.keepAll),
                               static_cast<double>(settings.shadows),
                               static_cast<double>(request.fixedQuality.has_value()),
                               request.targetError.value_or(0)};
    for (const std::optional<double>& threshold :
         {settings.thresholds.blur, settings.thresholds.size, settings.thresholds.light})
        key.push_back(threshold.value_or(-1));
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row) key.push_back(view.worldFromCamera[column][row]);
    Lens lens = view.lens;
    lens.exposureTime = lens.iso = 1;  // a matter of display
    for (const LensField& field : lensFields()) key.push_back(lensFieldValue(lens, field));
    return key;
}

std::vector<double> displayKey(const DisplaySettings& display) {
    return {static_cast<double>(display.toneMap),
            display.exposure,
            static_cast<double>(display.overlay),
            static_cast<double>(display.focusPeaking),
            static_cast<double>(display.focusPlane),
            static_cast<double>(display.wireframe),
            display.divider,
            static_cast<double>(display.difference),
            display.differenceGain};
}

// The view at another resolution: limits of the blur are px of the image.
View resized(const View& view, double resolution) {
    View result = view;
    result.width = std::max(1, static_cast<int>(std::lround(view.width * resolution)));
    result.height = std::max(1, static_cast<int>(std::lround(view.height * resolution)));
    const double scale = static_cast<double>(result.width) / view.width;
    result.lens.foregroundLimit *= scale;
    result.lens.backgroundLimit *= scale;
    return result;
}

RenderSettings settingsOf(const RenderSettings& settings, const PictureSide& side) {
    RenderSettings result = settings;
    result.lod = side.lod;
    result.firstSample = side.firstSample;
    return result;
}

// Returns the time of the set-up, ms.
double addPasses(std::vector<PassShare>& passes, const RenderStats& stats, const std::string& side) {
    for (const PassTime& pass : stats.passes) passes.push_back({pass.name + side, pass.milliseconds});
    if (stats.passes.empty()) passes.push_back({"waves" + side, stats.gpuMilliseconds});
    return stats.setupMilliseconds;
}

}  // namespace

ViewPicture::ViewPicture(const World& world, RendererOptions options, bool software)
    : world_(&world), options_(std::move(options)), software_(software), display_(options_.shaderFolder) {}

bool ViewPicture::update(const PictureRequest& request, FrameBudget& budget) {
    // What has changed?
    const bool otherSides = !firstSide_ || !(*firstSide_ == request.first) ||
                            secondSide_.has_value() != request.second.has_value() ||
                            (request.second && !(*secondSide_ == *request.second));
    if (otherSides) prepareSides(request);
    const std::vector<double> key = imageKey(request);
    const bool changed = otherSides || key != lastKey_;
    const std::vector<double> shown = displayKey(request.display);
    bool presents = shown != lastDisplayKey_;
    lastKey_ = key;
    lastDisplayKey_ = shown;

    // Draw a frame, wait until hands are still, or let the image grow.
    showsWork_ = request.display.overlay == DisplayOverlay::work;
    if (changed) {
        ++changes_;
        drawMoving(request, budget);
        growing_ = false;
        grows_ = true;
        settlesAt_ = Clock::now() + settling;
        presents = true;
    } else if (!growing_ && !request.fixedQuality && Clock::now() >= settlesAt_) {
        beginGrowing(request);
    } else if (grown_) {
        presents = presents || fewestSamples() >= static_cast<std::uint32_t>(nextShown * presentedSamples_) || !grows_;
    }
    grown_ = false;
    if (showsWork_ && !changed && (!workCurrent_ || workGrows_)) {
        growWork(growthTime(budget));
        presents = true;
    }
    const bool tooFew = growing_ && grows_ && fewestSamples() < firstShownSample;
    if (!presents || tooFew) return false;
    presentedSamples_ = shownSamples_ = fewestSamples();
    present(request);
    return true;
}

double ViewPicture::growthTime(const FrameBudget& budget) const {
    const bool shares = showsWork_ && growing_ && grows_ && (!workCurrent_ || workGrows_);  // the image and its work
    return std::max(budget.milliseconds, software_ ? softwareGrowth : 0.0) * (shares ? 0.5 : 1);
}

std::uint32_t ViewPicture::fewestSamples() const {
    return std::min(first_->samples(), second_ ? second_->samples() : first_->samples());
}

void ViewPicture::prepareSides(const PictureRequest& request) {
    if (!firstSide_ || firstSide_->method.text() != request.first.method.text()) {
        first_.reset();
        first_.emplace(*world_, request.first.method, options_);
        fresh_ = true;
    }
    if (!request.second)
        second_.reset();
    else if (!second_ || secondSide_->method.text() != request.second->method.text()) {
        second_.reset();
        second_.emplace(*world_, request.second->method, options_);
        fresh_ = true;
    }
    firstSide_ = request.first;
    secondSide_ = request.second;
    psnr_.reset();
}

void ViewPicture::drawMoving(const PictureRequest& request, FrameBudget& budget) {
    const FrameQuality quality = request.fixedQuality.value_or(budget.quality());
    const Clock::time_point begin = Clock::now();
    View view = resized(request.view, quality.resolution);
    RenderSettings settings = request.settings;
    settings.sampleCount = quality.samples;
    fixThresholds(settings, quality.samples, quality.thresholdBias);
    FramePlan plan = planFrame(*world_, view, settingsOf(settings, request.first));
    const double blur = plan.largestBlur / quality.resolution;  // px of the window
    // Where one sample says all, rather each pixel of the window than many samples of every fourth.
    const bool sharp = !request.fixedQuality && (!view.lens.dofEnabled || blur < leastBlur);
    if (sharp) view = request.view;
    if (sharp || quality.samples == 1) {
        settings.sampleCount = 1;
        view.lens.dofEnabled = false;
        plan = planFrame(*world_, view, settingsOf(settings, request.first));
    }
    first_->drawFrame(std::move(plan));
    if (second_) second_->drawFrame(view, settingsOf(settings, *request.second));
    workCurrent_ = workGrows_ = false;
    if (showsWork_) growWork(std::numeric_limits<double>::infinity());
    const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    // The picture may have half of the budget at least: no interface is worth another rung.
    const double rest = std::min(request.restOfFrame, 0.5 * budget.milliseconds);
    if (!fresh_ && !request.fixedQuality && !sharp) budget = adapted(budget, milliseconds + rest);
    fresh_ = false;
    aovsCurrent_ = false;
    psnr_.reset();
    passTotals_.clear();
    notePasses();
}

void ViewPicture::beginGrowing(const PictureRequest& request) {
    growing_ = true;
    grows_ = true;
    ++begun_;
    passTotals_.clear();
    presentedSamples_ = firstShownSample - 1;
    first_->begin(request.view, settingsOf(request.settings, request.first), request.mostSamples, request.targetError);
    if (second_)
        second_->begin(request.view, settingsOf(request.settings, *request.second), request.mostSamples,
                       request.targetError);
    nextPsnr_ = Clock::now() + psnrEvery;
    aovsCurrent_ = workCurrent_ = workGrows_ = false;
}

void ViewPicture::grow(const FrameBudget& budget) {
    if (!growing_ || !grows_) return;
    grown_ = true;
    // Two sides take turns, the one behind first, so that they stay comparable.
    const bool secondBehind =
        second_ && !second_->finished() && (first_->finished() || second_->samples() < first_->samples());
    (secondBehind ? *second_ : *first_).grow(growthTime(budget));
    grows_ = !first_->finished() || (second_ && !second_->finished());
    notePasses();
}

// The renderer's times are sums since its frame was started, which a growing image shares between many frames.
void ViewPicture::notePasses() {
    std::vector<PassShare> totals;
    double setup = addPasses(totals, first_->stats(), "");
    if (second_) setup += addPasses(totals, second_->stats(), ", right");
    passes_ = totals;
    if (passTotals_.size() == totals.size())
        for (std::size_t i = 0; i < totals.size(); ++i) passes_[i].milliseconds -= passTotals_[i].milliseconds;
    passTotals_ = std::move(totals);
    const bool setUp = std::exchange(setupTotal_, setup) != setup;
    passes_.push_back({"set-up", setUp ? setup : 0});
    // Overlays and display are those of the frame before: nobody waits for them.
    if (const double overlays = overlayTimer_.milliseconds(); overlays > 0) passes_.push_back({"overlays", overlays});
    overlayTimer_.reset();
    passes_.push_back({"display", displayTimer_.milliseconds()});
}

void ViewPicture::drawAovs() {
    if (!aovs_) aovs_.emplace(*world_, options_.shaderFolder);
    overlayTimer_.begin();
    aovs_->draw(first_->plan(), firstSide_->method.sharesImages());
    overlayTimer_.end();
    aovsCurrent_ = true;
    wireframeCurrent_ = false;
}

void ViewPicture::growWork(double milliseconds) {
    if (!work_) work_.emplace(*world_, options_.shaderFolder);
    if (!workCurrent_) work_->begin(first_->plan());
    workCurrent_ = true;
    overlayTimer_.begin();
    workGrows_ = work_->grow(milliseconds);
    overlayTimer_.end();
}

void ViewPicture::present(const PictureRequest& request) {
    const DisplaySettings& display = request.display;
    if (display.needsAovs() && !aovsCurrent_) drawAovs();
    if (display.wireframe && !wireframeCurrent_) {
        overlayTimer_.begin();
        aovs_->drawWireframe();
        overlayTimer_.end();
        wireframeCurrent_ = true;
    }
    DisplayInputs inputs;
    inputs.first = first_->texture();
    if (second_) inputs.second = second_->texture();
    if (aovsCurrent_) {
        inputs.coc = &aovs_->coc();
        inputs.level = &aovs_->level();
        inputs.rate = &aovs_->rate();
        if (wireframeCurrent_) inputs.wireframe = &aovs_->wireframe();
    }
    if (workCurrent_) {
        inputs.work = &work_->work();
        inputs.workSamples = std::max(1u, work_->samples());
    }
    if (second_ && growing_ && Clock::now() >= nextPsnr_) {
        psnr_ = display_.psnr(*inputs.first, *inputs.second);
        nextPsnr_ = Clock::now() + psnrEvery;
    }
    displayTimer_.reset();
    displayTimer_.begin();
    // A frame of a movement is enlarged last, with the window: on a CPU each pixel of this pass counts.
    const TextureInfo& image = inputs.first->info();
    const bool whole = growing_ || display.wireframe;
    display_.draw(inputs, display, whole ? request.view.width : image.width,
                  whole ? request.view.height : image.height);
    displayTimer_.end();
}

}  // namespace defocus
