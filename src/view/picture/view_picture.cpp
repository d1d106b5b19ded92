#include "view/picture/view_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <utility>

#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

using namespace std::chrono_literals;

constexpr auto settleTime = 120ms;  // time without changes after which the view counts as at rest
// An image with fewer samples looks worse than the last frame of the moving view.
constexpr std::uint32_t minShownSamples = 4;
constexpr double visibleGrowth = 1.08;  // update the window when the sample count has grown by this factor
// Min time in ms that a frame spends on adding samples if OpenGL runs on the CPU.
constexpr double softwareGrowthTime = 60;
constexpr auto psnrInterval = 700ms;

// Returns the numeric values of a request that affect its images. update() compares the settings, the sides of the
// comparison, the aperture image and focusKey() separately. Exposure time and ISO are omitted, because they affect only
// the display.
std::vector<double> imageKey(const PictureRequest& request) {
    const View& view = request.view;
    std::vector<double> key = {static_cast<double>(view.width), static_cast<double>(view.height), view.nearPlane,
                               static_cast<double>(request.poseVersion),
                               static_cast<double>(request.fixedQuality.has_value())};
    const double* const matrix = glm::value_ptr(view.worldFromCamera);
    key.insert(key.end(), matrix, matrix + 16);
    Lens lens = view.lens;
    lens.exposureTime = lens.iso = lens.focusDistance = lens.fStop = 1;
    for (const LensField& field : lensFields()) key.push_back(lensFieldValue(lens, field));
    return key;
}

// Returns the lens values that can change without rendering, because the picture is then computed from stored lens
// images.
std::vector<double> focusKey(const Lens& lens) {
    return {lens.focusDistance, lens.fStop};
}

// Returns the view at another resolution. Limits on the blur that are given in px are scaled with the resolution.
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
    if (!parseMethodUse(side.method).method->drawsPositions) result.positions = 1;
    result.lod = side.lod;
    result.firstSample = side.firstSample;
    return result;
}

// Appends the times of an image's render passes. Returns the set-up time of the image, ms.
double addPasses(std::vector<PassTime>& passes, const RenderStats& stats, const std::string& side) {
    for (const PassTime& pass : stats.passes) passes.push_back({pass.name + side, pass.milliseconds});
    if (stats.passes.empty()) passes.push_back({"waves" + side, stats.gpuMilliseconds});
    return stats.setupMilliseconds;
}

}  // namespace

ViewPicture::ViewPicture(const World& world, RendererOptions options, bool software)
    : world_(&world), options_(std::move(options)), software_(software), display_(options_.shaderFolder) {}

const FramePlan& ViewPicture::plan() const {
    static const FramePlan empty;
    if (refocused_) return refocused_->plan;
    return sides_.empty() ? empty : first().plan();
}

std::uint32_t ViewPicture::samples() const {
    if (refocused_) return refocused_->images;
    return sides_.empty() ? 0 : first().samples();
}

const GlTexture& ViewPicture::firstTexture() {
    return refocused_ ? images_->picture() : *sides_[0]->image.texture();
}

void ViewPicture::update(const PictureRequest& request, FrameBudget& budget) {
    const std::vector<double> key = imageKey(request);
    const std::shared_ptr<const Image>& aperture = request.view.lens.apertureImage;
    const bool otherSettings = request.settingsKey != lastSettings_;
    const std::vector<double> focus = focusKey(request.view.lens);
    const bool otherScene = prepareSides(request) || key != lastKey_ || otherSettings || aperture != lastAperture_;
    const bool changed = otherScene || focus != lastFocusKey_;
    lastKey_ = key;
    lastFocusKey_ = focus;
    lastSettings_ = request.settingsKey;
    lastAperture_ = aperture;
    bool presents = request.display != lastDisplay_;
    lastDisplay_ = request.display;

    showsWork_ = request.display.overlay == DisplayOverlay::work;
    if (otherScene && images_) images_->discard();
    if (changed) {
        ++changes_;
        refocused_.reset();
        if (otherScene || !drawRefocused(request)) drawMoving(request, budget);
        growing_ = false;
        grows_ = true;
        settlesAt_ = Clock::now() + settleTime;
        presents = true;
    } else if (!growing_ && !request.fixedQuality && Clock::now() >= settlesAt_) {
        beginGrowing(request);
    } else if (grown_ && refocused_) {
        if (minSamples() >= refocused_->images || !grows_) {
            refocused_.reset();
            aovsCurrent_ = false;
            presents = true;
        }
    } else if (grown_) {
        presents = presents || minSamples() >= static_cast<std::uint32_t>(visibleGrowth * presentedSamples_) || !grows_;
    }
    grown_ = false;
    if (showsWork_ && !changed && workIncomplete()) {
        growWork(growthTime(budget));
        presents = true;
    }
    const bool tooFew = growing_ && grows_ && !refocused_ && minSamples() < minShownSamples;
    if (!presents || tooFew) return;
    presentedSamples_ = minSamples();
    present(request);
}

double ViewPicture::growthTime(const FrameBudget& budget) const {
    // The time is split between the image and the overlay that counts triangles per pixel.
    const bool shares = showsWork_ && growing_ && grows_ && workIncomplete();
    return std::max(budget.milliseconds, software_ ? softwareGrowthTime : 0.0) * (shares ? 0.5 : 1);
}

std::uint32_t ViewPicture::minSamples() const {
    return std::min(first().samples(), sides_.back()->image.samples());
}

// Creates renderers for the sides of the comparison whose method has changed. Returns whether any side has changed.
bool ViewPicture::prepareSides(const PictureRequest& request) {
    const auto same = [](const std::unique_ptr<Side>& side, const PictureSide& wanted) {
        return side->shows == wanted;
    };
    if (std::ranges::equal(sides_, request.sides, same)) return false;
    sides_.resize(request.sides.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const PictureSide& wanted = request.sides[i];
        if (sides_[i] && sides_[i]->shows.method == wanted.method) {
            sides_[i]->shows = wanted;
            continue;
        }
        sides_[i].reset();  // free its memory before the next allocation
        sides_[i] = std::make_unique<Side>(Side{wanted, {*world_, parseMethodUse(wanted.method), options_}});
        fresh_ = true;
    }
    psnr_.reset();
    return true;
}

void ViewPicture::drawMoving(const PictureRequest& request, FrameBudget& budget) {
    const FrameQuality quality = request.fixedQuality.value_or(budget.quality());
    const Clock::time_point begin = Clock::now();
    View view = resized(request.view, quality.resolution);
    RenderSettings settings = request.settings;
    settings.sampleCount = quality.samples;
    fixThresholds(settings, quality.samples, quality.thresholdBias);
    FramePlan plan = planFrame(*world_, view, settingsOf(settings, request.sides[0]));
    const double blur = plan.largestBlur / quality.resolution;  // blur in window pixels
    // Without visible blur, one sample at full resolution looks better than many samples at half the resolution.
    const bool sharp = !request.fixedQuality && (!view.lens.dofEnabled || blur < minBlur);
    if (sharp) view = request.view;
    if (sharp || quality.samples == 1) {
        settings.sampleCount = 1;
        view.lens.dofEnabled = false;
        plan = planFrame(*world_, view, settingsOf(settings, request.sides[0]));
    }
    sides_[0]->image.drawFrame(std::move(plan));
    if (sides_.size() > 1) sides_[1]->image.drawFrame(view, settingsOf(settings, request.sides[1]));
    aovsCurrent_ = workCurrent_ = workGrows_ = false;
    if (showsWork_) growWork(std::numeric_limits<double>::infinity());
    const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    // Keep at least half of the budget for the picture, even if a slow interface takes more than the other half.
    const double rest = std::min(request.restOfFrame, 0.5 * budget.milliseconds);
    if (!fresh_ && !request.fixedQuality && !sharp) budget = adapted(budget, milliseconds + rest);
    fresh_ = false;
    psnr_.reset();
    passTotals_.clear();
    notePasses();
}

// Computes the picture from the stored lens images. Returns false if too few of them suit the request's lens.
bool ViewPicture::drawRefocused(const PictureRequest& request) {
    const Lens& lens = request.view.lens;
    const std::uint32_t serving = images_ && images_->complete() && !showsWork_ ? images_->serving(lens) : 0;
    if (serving == 0) return false;
    const Clock::time_point begin = Clock::now();
    images_->refocus(lens);
    waitForGpu();
    const double time = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    RenderSettings settings = settingsOf(request.settings, request.sides[0]);
    settings.sampleCount = serving;
    refocused_ = {planFrame(*world_, request.view, settings), serving};
    aovsCurrent_ = workCurrent_ = workGrows_ = false;
    passTotals_.clear();
    passes_ = {{"refocus", time}};
    return true;
}

void ViewPicture::beginGrowing(const PictureRequest& request) {
    growing_ = true;
    grows_ = true;
    ++begun_;
    passTotals_.clear();
    presentedSamples_ = minShownSamples - 1;
    for (const std::unique_ptr<Side>& side : sides_)
        side->image.begin(request.view, settingsOf(request.settings, side->shows), request.maxSamples,
                          request.targetError);
    nextPsnr_ = Clock::now() + psnrInterval;
    aovsCurrent_ = workCurrent_ = workGrows_ = false;
    planImages(request);
}

// Plans lens images for a view at rest, unless suitable lens images are already stored.
void ViewPicture::planImages(const PictureRequest& request) {
    const bool sums = parseMethodUse(request.sides[0].method).method->sumsBlocks;
    if (request.imageBytes == 0 || request.sides.size() > 1 || !sums) return;
    if (!images_) images_.emplace(*world_, options_, software_);
    if (images_->serving(request.view.lens) > 0) return;
    images_->begin(request.view, settingsOf(request.settings, request.sides[0]), first().plan(), request.imageBytes);
}

// Returns whether the next call of grow() draws lens images to store, instead of samples of the picture.
bool ViewPicture::keepsMore() const {
    if (!growing_ || !images_ || images_->drawn() == images_->planned()) return false;
    return first().samples() >= blockSamples || !grows_;
}

void ViewPicture::grow(const FrameBudget& budget) {
    if (keepsMore()) {
        images_->grow(growthTime(budget));
        return;
    }
    if (!growing_ || !grows_) return;
    grown_ = true;
    // Add samples to the side with fewer samples, so that both sides stay comparable.
    ProgressiveImage& left = sides_.front()->image;
    ProgressiveImage& right = sides_.back()->image;
    const bool rightIsBehind = !right.finished() && (left.finished() || right.samples() < left.samples());
    (rightIsBehind ? right : left).grow(growthTime(budget));
    grows_ = !left.finished() || !right.finished();
    notePasses();
}

// Updates the pass times of the latest frame. A renderer sums its times since the image was begun, so the sums of the
// previous frame are subtracted.
void ViewPicture::notePasses() {
    std::vector<PassTime> totals;
    double setup = 0;
    for (const std::unique_ptr<Side>& side : sides_)
        setup += addPasses(totals, side->image.stats(), side == sides_.front() ? "" : ", right");
    passes_ = totals;
    if (passTotals_.size() == totals.size())
        for (std::size_t i = 0; i < totals.size(); ++i) passes_[i].milliseconds -= passTotals_[i].milliseconds;
    passTotals_ = std::move(totals);
    const bool setUp = std::exchange(setupTotal_, setup) != setup;
    passes_.push_back({"set-up", setUp ? setup : 0});
    // Use the previous frame's times of overlays and display, so that the CPU doesn't wait for the GPU.
    if (const double overlays = overlayTimer_.milliseconds(); overlays > 0) passes_.push_back({"overlays", overlays});
    overlayTimer_.reset();
    passes_.push_back({"display", displayTimer_.milliseconds()});
}

void ViewPicture::drawAovs(bool wireframe) {
    if (aovsCurrent_ && (wireframeCurrent_ || !wireframe)) return;
    overlayTimer_.begin();
    if (!aovs_) aovs_.emplace(*world_, options_.shaderFolder);
    if (!aovsCurrent_) aovs_->draw(plan());
    if (wireframe) aovs_->drawWireframe();
    overlayTimer_.end();
    aovsCurrent_ = true;
    wireframeCurrent_ = wireframe;
}

void ViewPicture::growWork(double milliseconds) {
    if (!work_) work_.emplace(*world_, options_.shaderFolder);
    if (!workCurrent_) work_->begin(plan());
    workCurrent_ = true;
    overlayTimer_.measure([&] { workGrows_ = work_->grow(milliseconds); });
}

void ViewPicture::present(const PictureRequest& request) {
    const DisplaySettings& display = request.display;
    if (display.needsAovs()) drawAovs(display.wireframe);
    DisplayInputs inputs;
    inputs.first = &firstTexture();
    if (sides_.size() > 1) inputs.second = sides_[1]->image.texture();
    if (aovsCurrent_) {
        inputs.coc = &aovs_->coc();
        inputs.level = &aovs_->level();
        if (wireframeCurrent_) inputs.wireframe = &aovs_->wireframe();
    }
    if (workCurrent_) {
        inputs.work = &work_->work();
        inputs.workSamples = std::max(1u, work_->samples());
    }
    if (inputs.second != nullptr && growing_ && Clock::now() >= nextPsnr_) {
        psnr_ = display_.psnr(*inputs.first, *inputs.second);
        nextPsnr_ = Clock::now() + psnrInterval;
    }
    displayTimer_.reset();
    displayTimer_.begin();
    // While the view moves, draw at the reduced resolution of the rendered image, because the display pass is slow on a
    // CPU. The window scales the result up.
    const TextureInfo& image = inputs.first->info();
    const bool fullSize = growing_ || display.wireframe;
    display_.draw(inputs, display, fullSize ? request.view.width : image.width,
                  fullSize ? request.view.height : image.height);
    displayTimer_.end();
}

}  // namespace defocus::engine
