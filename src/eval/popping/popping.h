#pragma once
// Measures the popping of levels of detail: the change from frame to frame that levels add while camera, focus or scene
// move. Compares four modes. nearest: one level per object. fractional: samples divided between two levels. continuous:
// like fractional, but one sample draws the finer level in some pixels and the coarser level in the others. multirate:
// fractional levels, drawn by the multirate method instead of accumulation.
//
// The reference is full detail with the same lens samples. For multirate, the reference is drawn by multirate, too.
// Sampling noise therefore cancels, and full detail itself measures 0. Let I be a frame of the mode and R the same
// frame at full detail, both display-encoded:
//   change: (I_t − I_{t−1}) − (R_t − R_{t−1}). The bench measures its RMSE, and the FLIP between I_t and the expected
//           frame I_{t−1} + (R_t − R_{t−1}), clipped to [0, 1]. The change includes pops and all other errors of the
//           levels that move with the camera.
//   step:   I_t minus the same view and pose drawn with the previous frame's levels and its splits of the
//           samples between two levels. The step is the pop alone.
// Both are measured over the complete image and over the object pixels: the pixels that an object or its blur covers in
// frame t or t − 1. For the step, only objects whose levels or splits differ count. Unchanged objects thus don't dilute
// a pop, and the error of a pop hardly depends on the number of objects that pop in a frame.
//
// Expected step, as an RMSE: let w px be the width of the region in which the sharp images of two levels differ. If all
// N samples change their level at once, the lens blurs this difference over the CoC, c px. If a single sample changes,
// the difference stays sharp. The step is then √(c/w)/N times as large as with all samples. Let Δλ be the change of an
// object's real-valued level per frame. If less than one sample changes per frame (Δλ·N < 1), fractional levels make
// this step in some frames and none in the others. Continuous levels change a fraction Δλ·N of the sample's pixels in
// every frame. The step is then √(c/w)·√(Δλ/N) times as large as with all samples, and half as large at a quarter of
// the speed.
//
// Equal for all modes: scene, views, number of lens samples, thresholds, image size and, except for multirate,
// renderer. The layers, which hold the images of single samples, are 32-bit floats by default. Their rounding thus
// doesn't count as an error of the levels.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "eval/popping/paths.h"
#include "render/methods.h"

namespace defocus::engine {

enum class PoppingMode { nearest, fractional, continuous, multirate };

inline constexpr std::array poppingModes = {PoppingMode::nearest, PoppingMode::fractional, PoppingMode::continuous,
                                            PoppingMode::multirate};

std::string_view poppingModeName(PoppingMode mode);

struct PoppingOptions {
    std::vector<Movement> movements = {Movement::focusPull, Movement::dolly, Movement::turntable};
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32};
    int clip = 0;          // index of the scene's clip, for Movement::clip
    int pathFrames = 240;  // number of frames of a complete movement; determines its speed
    int frames = 48;       // consecutive frames to measure per movement, those with the most level changes
    RenderSettings plan;   // settings that the bench keeps constant: seed, metric, keepAll …
    RendererOptions renderer;
};

struct PopError {
    double rmse = 0;
    double flip = 0;  // mean FLIP over the measured pixels
};

struct Pop {
    PopError image;
    PopError objects;
};

struct PoppingFrame {
    Movement movement = Movement::focusPull;
    std::uint32_t samples = 0;
    PoppingMode mode = PoppingMode::nearest;
    int frame = 0;     // number of the frame within the measured frames of the movement, ≥ 1
    double speed = 0;  // max over all objects of |λ_t − λ_{t−1}|; λ_t is the object's real-valued level in frame t
    Pop change;
    Pop step;
};

// Change of the image when one sample switches its level, relative to the change when all samples switch, for a static
// object. RMSEs are of linear values over the complete image.
struct SampleStep {
    std::uint32_t samples = 0;  // number of lens samples N
    std::string object;
    std::uint32_t level = 0;  // finer of the two levels
    double coc = 0;           // CoC diameter in px at the middle of the object's depth range
    double edgeError = 0;     // surface error of the coarser level, px; estimates the width w, see above
    double expected = 0;      // predicted value of `measured`: √(coc/edgeError)/N if coc > edgeError, else 1/N
    double measured = 0;      // RMS change as samples switch one by one, relative to the change if all switch at once
};

struct PoppingVisitor {
    // Called once, with the frames of all modes, after the first quarter of the first movement, so that a first result
    // appears within seconds. May be empty.
    std::function<void(std::span<const PoppingFrame>)> firstFrames;
    // Called once for each movement and each number of samples, with the frames of all modes.
    std::function<void(std::span<const PoppingFrame>)> frames;
    std::function<void(const SampleStep&)> sampleStep;
};

// Measures the popping for each movement and each number of samples, then a SampleStep for each number of samples.
// Needs a current GL context. Sets the pose of `world` for each frame and restores it at the end. Throws Error in the
// same cases as planning, rendering and framesAlong.
void measurePopping(World& world, const View& view, const PoppingOptions& options, const PoppingVisitor& visitor,
                    const Progress& progress = {});

}  // namespace defocus::engine
