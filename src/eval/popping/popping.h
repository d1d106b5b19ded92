#pragma once
// Measures the popping of levels of detail: the change that they add from frame to frame while camera, focus or scene
// move. It compares four modes: the nearest level; samples split between two levels (fractional); the same with the
// sample at the boundary split by pixels (continuous); and fractional levels drawn by the method "multirate".
//
// The reference is full detail at the same lens samples; multirate has lens samples of its own. Sampling noise cancels,
// and full detail itself measures 0. Let I be a frame of the mode and R the same frame at full detail, both
// display-encoded:
//   change: (I_t − I_{t−1}) − (R_t − R_{t−1}). The bench measures its RMSE, and the FLIP between I_t and the expected
//           frame I_{t−1} + (R_t − R_{t−1}), clipped to [0, 1]. The change includes pops and all other errors of the
//           levels that move with the camera.
//   step:   I_t minus the same view and pose drawn with the levels and splits of the previous frame. The
//           step is the pop alone.
// Both are measured over the complete image and over the objects' pixels, which an object or its blur touches in either
// frame. For the step, only objects whose draws differ count. Unchanged objects therefore don't dilute a pop, and its
// error hardly depends on how many objects pop in a frame.
//
// How large should a step be? If all N samples change their level at once, the difference is blurred by c px. The
// difference of one sample is sharp, w px wide. The step of one sample is therefore √(c/w)/N of the pop of all samples.
// If less than one sample changes in a frame (Δλ·N < 1), fractional levels make this step in some frames and none in
// the others. Continuous levels change a share Δλ·N of the sample's pixels in every frame, which gives √(c/w)·√(Δλ/N):
// half as much at a quarter of the speed.
//
// Held equal between modes: scene, views, lens samples, thresholds, size and, except for multirate, renderer. Layers
// are 32-bit floats by default, so that their rounding doesn't count as an error of the levels.

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
    int clip = 0;          // number of the scene's clip, for Movement::clip
    int pathFrames = 240;  // frames of a complete movement, which set its speed
    int frames = 48;       // measured frames of each movement, with the most level changes
    RenderSettings plan;   // settings that the bench doesn't vary: seed, metric, keepAll …
    RendererOptions renderer;
};

struct PopError {
    double rmse = 0;
    double flip = 0;  // mean
};

struct Pop {
    PopError image;
    PopError objects;
};

struct PoppingFrame {
    Movement movement = Movement::focusPull;
    std::uint32_t samples = 0;
    PoppingMode mode = PoppingMode::nearest;
    int frame = 0;     // t ≥ 1
    double speed = 0;  // the largest |λ_t − λ_{t−1}| of all objects
    Pop change;
    Pop step;
};

// The step of one sample compared with the pop of all samples, for a static object. The RMSEs are of linear values over
// the image.
struct SampleStep {
    std::uint32_t samples = 0;
    std::string object;
    std::uint32_t level = 0;  // the finer of the two levels
    double coc = 0;           // px, at the object's middle depth
    double edgeError = 0;     // px, the deviation of the coarser level
    double expected = 0;      // √(coc/edgeError)/N, if coc > edgeError
    double measured = 0;      // RMS of all N steps, divided by the RMSE between the two levels
};

struct PoppingVisitor {
    // Gets the frames of one movement and number of samples, in all modes.
    std::function<void(std::span<const PoppingFrame>)> frames;
    std::function<void(const SampleStep&)> sampleStep;
};

// Measures all movements and numbers of samples. Needs a current GL context. `world` takes the pose of each frame and
// gets its own pose back at the end. Throws Error like planning, rendering and framesAlong.
void measurePopping(World& world, const View& view, const PoppingOptions& options, const PoppingVisitor& visitor,
                    const Progress& progress = {});

// Returns an image that is 1 where a pixel shows an object or lies within half a circle of confusion of one, and 0
// elsewhere. `level` (−1 where there is no object) and `coc` (px) come from AovImages.
Image objectPixels(const Image& level, const Image& coc);

}  // namespace defocus::engine
