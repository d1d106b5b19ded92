#pragma once
// Renders the window's picture on the GPU: one image, or two images for comparison, and overlays. While the view
// changes, each frame is drawn completely, at a quality that fits the time budget. While the view is at rest, the image
// accumulates samples.
//
// After the first batch of samples of a view at rest, the images of its lens samples are also drawn and kept as lens
// images (kept_images.h). If only the focus distance or the f-number changes, the picture is computed from these images
// until the accumulated image has as many samples. If OpenGL runs on the CPU and summing all these images takes longer
// than the budget, only some of them are used until the view rests.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl/read_back.h"
#include "gl/timer.h"
#include "render/aov/aov.h"
#include "render/aov/work.h"
#include "render/display/display_pass.h"
#include "render/sampling/progressive_image.h"
#include "view/picture/kept_images.h"
#include "view/state/frame_budget.h"

namespace defocus::engine {

struct PictureSide {
    std::string method;  // method and its settings, in the format of MethodUse::text
    LodMode lod = LodMode::fractional;
    std::uint32_t firstSample = 0;
    bool operator==(const PictureSide&) const = default;
};

struct PictureRequest {
    View view;                       // view at the window's resolution
    RenderSettings settings;         // settings; level thresholds, if set, replace the defaults
    std::string settingsKey;         // text that identifies the settings; when it changes, the image is restarted
    std::uint64_t poseVersion = 0;   // Document::poseVersion of the pose to draw
    std::vector<PictureSide> sides;  // one element, or the left and the right side of a comparison
    DisplaySettings display;
    std::uint32_t maxSamples = 4096;
    std::optional<double> targetError;         // estimated error below which accumulation stops
    std::optional<FrameQuality> fixedQuality;  // replaces the quality that fits the budget; disables accumulation
    double restOfFrame = 0;                    // time that the interface takes from the frame's budget, ms
    std::uint64_t imageBytes = 0;              // max size of the kept lens images in bytes; 0: none are kept
};

class ViewPicture {
public:
    // `world` must outlive the picture. Needs a current GL context.
    ViewPicture(const World& world, RendererOptions options, bool software);

    // Adds samples to the image of a view at rest for about the budget's time, at least 60 ms if OpenGL runs on the
    // CPU. Call this before fetching the events of a frame, so that the frame reacts to events that arrive meanwhile.
    void grow(const FrameBudget& budget);
    // Updates the picture to match the request. While the view changes, draws a frame that takes about as long as the
    // budget allows. Then chooses the quality of the next frame and stores it in `budget`.
    void update(const PictureRequest& request, FrameBudget& budget);

    [[nodiscard]] const GlTexture& texture() const { return display_.texture(); }
    [[nodiscard]] bool moving() const { return !growing_; }
    // Returns whether the picture is complete and thus stays the same until the request changes.
    [[nodiscard]] bool finished() const { return growing_ && !grows_ && !(showsWork_ && workGrows_); }
    // Returns whether grow() has nothing left to draw.
    [[nodiscard]] bool idle() const { return finished() && !keepsMore(); }
    // Returns the number of lens samples in the first image. If the picture is refocused, returns the number of lens
    // images that it is computed from.
    [[nodiscard]] std::uint32_t samples() const;
    // Returns whether the picture is computed from stored lens images.
    [[nodiscard]] bool refocused() const { return refocused_.has_value(); }
    // Returns the stored lens images; null before the view first comes to rest.
    [[nodiscard]] const KeptImages* keptImages() const { return images_ ? &*images_ : nullptr; }
    // Returns whether the view is at rest and its image has reached the target error. In a comparison, only the image
    // on the left side counts.
    [[nodiscard]] bool converged() const { return growing_ && first().converged(); }
    [[nodiscard]] std::optional<double> estimatedError() const {
        return growing_ && !refocused_ ? first().estimatedError() : std::nullopt;
    }
    // Returns the image of the view, or of the left side of a comparison, as linear RGBA.
    [[nodiscard]] Image image() { return readBack(firstTexture(), 4); }
    [[nodiscard]] const FramePlan& plan() const;  // plan of the image that image() returns; empty without an image
    // Returns the right side of a comparison; null without a comparison.
    [[nodiscard]] const PictureSide* secondSide() const { return sides_.size() > 1 ? &sides_[1]->shows : nullptr; }
    [[nodiscard]] const PictureSide& firstSide() const { return sides_[0]->shows; }
    // Returns the PSNR in dB between the two sides of a comparison.
    [[nodiscard]] std::optional<double> psnr() const { return psnr_; }
    [[nodiscard]] std::uint32_t workSamples() const { return work_ ? work_->samples() : 0; }
    [[nodiscard]] std::uint32_t wave() const { return sides_.empty() ? 0 : first().stats().wave; }
    // Returns the times of the latest frame. The GPU passes are timed with timer queries, the set-up by wall clock.
    [[nodiscard]] const std::vector<PassTime>& passes() const { return passes_; }
    [[nodiscard]] std::uint64_t changes() const { return changes_; }  // number of changes of the view or the scene
    [[nodiscard]] std::uint64_t begun() const { return begun_; }      // number of accumulated images begun so far

private:
    using Clock = std::chrono::steady_clock;
    struct Side {
        PictureSide shows;
        ProgressiveImage image;
    };

    // Picture computed from stored lens images, shown instead of the image of the left side, sides_[0].
    struct Refocused {
        FramePlan plan;
        std::uint32_t images = 0;
    };

    [[nodiscard]] const ProgressiveImage& first() const { return sides_[0]->image; }
    [[nodiscard]] const GlTexture& firstTexture();
    [[nodiscard]] std::uint32_t minSamples() const;                    // min sample count of the compared images
    [[nodiscard]] double growthTime(const FrameBudget& budget) const;  // time in ms that one call of grow() may take
    bool prepareSides(const PictureRequest& request);
    void drawMoving(const PictureRequest& request, FrameBudget& budget);
    bool drawRefocused(const PictureRequest& request);
    void beginGrowing(const PictureRequest& request);
    void planImages(const PictureRequest& request);
    [[nodiscard]] bool keepsMore() const;
    void present(const PictureRequest& request);
    void notePasses();
    void drawAovs(bool wireframe);
    void growWork(double milliseconds);
    [[nodiscard]] bool workIncomplete() const { return !workCurrent_ || workGrows_; }

    const World* world_;
    RendererOptions options_;
    bool software_;
    DisplayPass display_;
    std::optional<AovPass> aovs_;
    std::optional<WorkPass> work_;
    bool aovsCurrent_ = false;  // true: the AOVs of the current view are drawn
    bool wireframeCurrent_ = false;
    bool workCurrent_ = false;
    bool workGrows_ = false;  // true: the work overlay needs more samples
    std::vector<std::unique_ptr<Side>> sides_;
    std::optional<KeptImages> images_;
    std::optional<Refocused> refocused_;
    std::vector<double> lastKey_, lastFocusKey_;
    std::optional<DisplaySettings> lastDisplay_;
    std::string lastSettings_;
    std::shared_ptr<const Image> lastAperture_;
    Clock::time_point settlesAt_;
    Clock::time_point nextPsnr_;
    std::uint32_t presentedSamples_ = 0;
    bool showsWork_ = false;
    bool growing_ = false;  // true: the view is at rest and the image accumulates samples
    bool grows_ = false;    // true: the image needs more samples
    bool grown_ = false;    // true: samples were added since the latest update
    bool fresh_ = true;     // true: the next frame uploads the scene, so its time is ignored
    std::optional<double> psnr_;
    GpuTimer overlayTimer_, displayTimer_;
    std::vector<PassTime> passes_, passTotals_;
    double setupTotal_ = 0;
    std::uint64_t changes_ = 0;
    std::uint64_t begun_ = 0;
};

}  // namespace defocus::engine
