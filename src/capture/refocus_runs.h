#pragma once
// Finds runs of neighbouring frames of a still scene in which only focus distance, f-number and aperture shape change.
// One image per lens sample (lens image) is rendered for a run, and all frames of the run are computed from these
// images (src/refocus).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_sequence.h"
#include "frame/setup/settings_hash.h"
#include "refocus/kept_lens_images.h"
#include "refocus/refocus.h"

namespace defocus::engine {

struct RefocusRun {
    FrameRange frames;
    Lens lens;  // lens with the run's widest aperture; its focus distance is the harmonic mean of the ends of `range`
    FocusRange range;           // focus distances of the frames, m
    std::uint32_t samples = 0;  // number of lens images, at least the number of samples of a single frame

    // Returns a string that identifies the run's lens images, for the settings hash of its frames. It also states
    // whether these images have a disk as aperture. They have the frames' own aperture only if its shape and f-number
    // are the same in all frames.
    [[nodiscard]] std::string text() const;
};

struct RefocusRuns {
    std::vector<RefocusRun> runs;  // runs in frame order
    // Messages that say why frames are rendered one by one although they differ only in focus, f-number and aperture.
    std::vector<std::string> rendered;
};

// Divides `frames` into runs of consecutive frames that can be computed from one set of lens images. Each run has the
// length that saves the most lens samples. Frames for which no run saves any are in no run. `samples`: number of lens
// samples of a frame that is rendered on its own.
RefocusRuns refocusRuns(const Shot& shot, const SequenceBase& base, const FilmSettings& settings,
                        const FrameRange& frames, std::uint32_t samples);

// Returns the run of frames that contains a frame; null if there is none.
const RefocusRun* runOf(const std::vector<RefocusRun>& runs, int frame);

// Returns the memory in bytes that a run's lens images take. `view`: the view of any of the run's frames.
std::uint64_t memoryOf(const RefocusRun& run, const View& view);

// Computes frames from the lens images of their run (see RefocusRun). Keeps the lens images of one run at a time in
// memory.
class RefocusedPictures {
public:
    struct Picture {
        Image image;
        std::uint32_t samples = 0;  // number of lens images from which `image` is computed
        FramePlan plan;             // plan with which the lens images were rendered, but with the view of `image`
        bool rendered = false;      // true: the lens images were rendered for this frame
    };
    // Computes a frame of `run`, whose request and moment are given. Renders the run's lens images with `driver` if the
    // previous call was for another run; the driver's frame is then the one of these images. `step` receives the
    // finished fraction.
    Picture picture(const RefocusRun& run, Request request, const FrameMoment& moment, SceneDriver& driver,
                    const std::function<void(double)>& step);

private:
    const RefocusRun* run_ = nullptr;  // run that images_ belongs to
    std::optional<KeptLensImages> images_;
    FramePlan plan_;
};

}  // namespace defocus::engine
