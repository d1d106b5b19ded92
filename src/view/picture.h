#pragma once
// The picture of a window: draws a frame at once while things move, in the quality that the budget allows, and lets the
// image grow while nothing moves. One image, or two to compare; overlays on top.

#include <chrono>
#include <optional>

#include "gl/read_back.h"
#include "gl/timer.h"
#include "render/aov/aov.h"
#include "render/aov/work.h"
#include "render/display/display_pass.h"
#include "render/progressive_image.h"
#include "view/frame_budget.h"

namespace defocus {

struct PictureSide {
    MethodUse method;
    LodMode lod = LodMode::fractional;
    std::uint32_t firstSample = 0;
    bool operator==(const PictureSide& other) const {
        return method.text() == other.method.text() && lod == other.lod && firstSample == other.firstSample;
    }
};

struct PictureRequest {
    View view;                      // at the window's resolution
    RenderSettings settings;        // its thresholds count where they don't follow the samples
    std::uint64_t poseVersion = 0;  // another number: something in the world has moved
    PictureSide first;
    std::optional<PictureSide> second;
    DisplaySettings display;
    std::uint32_t mostSamples = 4096;
    std::optional<double> targetError;         // of a still image: it is finished once its error is below it
    std::optional<FrameQuality> fixedQuality;  // instead of the budget's, and no growing
    double restOfFrame = 0;                    // ms that the budget's frame takes beside the picture, as of late
};

struct PassShare {
    std::string name;
    double milliseconds = 0;
};

class ViewPicture {
public:
    // `world` must outlive it. Needs a current GL context.
    ViewPicture(const World& world, RendererOptions options, bool software);

    // Adds to a still image for about the budget's time, or 60 ms on a CPU; does nothing while things move. Before the
    // events of a frame are fetched, so that those which come meanwhile are answered by this frame and not by the next.
    void grow(const FrameBudget& budget);
    // Brings the picture up to date; one of things that move within about the budget, whose rung it adapts. Returns
    // whether the texture changed.
    bool update(const PictureRequest& request, FrameBudget& budget);

    [[nodiscard]] const GlTexture& texture() const { return display_.texture(); }
    [[nodiscard]] bool moving() const { return !growing_; }
    // Nothing is left to do until something changes.
    [[nodiscard]] bool finished() const { return growing_ && !grows_ && !(showsWork_ && workGrows_); }
    [[nodiscard]] std::uint32_t samples() const { return first_ ? first_->samples() : 0; }
    // Of the first side, with a target error, once the view is still.
    [[nodiscard]] bool converged() const { return growing_ && first_->converged(); }
    [[nodiscard]] std::optional<double> estimatedError() const {
        return growing_ ? first_->estimatedError() : std::nullopt;
    }
    [[nodiscard]] std::uint32_t shownSamples() const { return shownSamples_; }  // in the texture
    // The first side as it is, linear.
    [[nodiscard]] Image image() { return readBack(*first_->texture(), 4); }
    [[nodiscard]] const FramePlan& plan() const { return first_->plan(); }
    [[nodiscard]] const FramePlan* secondPlan() const { return second_ ? &second_->plan() : nullptr; }
    [[nodiscard]] std::optional<double> psnr() const { return psnr_; }  // of the two sides, dB
    // Lens samples in the heat map of work; 0 before it is asked for.
    [[nodiscard]] std::uint32_t workSamples() const { return work_ ? work_->samples() : 0; }
    [[nodiscard]] std::uint32_t wave() const { return first_ ? first_->stats().wave : 0; }  // samples drawn at once
    // Of the latest frame: passes by timer queries, set-up by the clock.
    [[nodiscard]] const std::vector<PassShare>& passes() const { return passes_; }
    // Times since the scene was there that things have changed, and that a still image was begun.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    [[nodiscard]] std::uint64_t begun() const { return begun_; }

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] std::uint32_t fewestSamples() const;                 // of both sides
    [[nodiscard]] double growthTime(const FrameBudget& budget) const;  // ms
    void prepareSides(const PictureRequest& request);
    void drawMoving(const PictureRequest& request, FrameBudget& budget);
    void beginGrowing(const PictureRequest& request);
    void present(const PictureRequest& request);
    void notePasses();
    void drawAovs();
    void growWork(double milliseconds);

    const World* world_;
    RendererOptions options_;
    bool software_;
    DisplayPass display_;
    std::optional<AovPass> aovs_;
    bool aovsCurrent_ = false;
    bool wireframeCurrent_ = false;
    std::optional<WorkPass> work_;
    bool workCurrent_ = false;  // is of this view
    bool workGrows_ = false;
    bool showsWork_ = false;
    std::optional<ProgressiveImage> first_, second_;
    std::optional<PictureSide> firstSide_, secondSide_;
    std::vector<double> lastKey_;
    std::vector<double> lastDisplayKey_;
    Clock::time_point settlesAt_;
    Clock::time_point nextPsnr_;
    std::uint32_t presentedSamples_ = 0;
    std::uint32_t shownSamples_ = 0;
    bool growing_ = false;
    bool grows_ = false;
    bool grown_ = false;  // since the latest update
    bool fresh_ = true;   // the next frame uploads: its time says nothing
    std::optional<double> psnr_;
    GpuTimer overlayTimer_, displayTimer_;
    std::vector<PassShare> passes_, passTotals_;
    double setupTotal_ = 0;
    std::uint64_t changes_ = 0;
    std::uint64_t begun_ = 0;
};

}  // namespace defocus
