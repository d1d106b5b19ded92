#pragma once
// How much levels of detail pop: what they add to the change from frame to frame while camera, focus or scene move, for
// the nearest level, samples split between two levels (fractional), and that with the sample at the boundary split over
// its pixels (continuous).
//
// The truth is full detail at the SAME lens samples: their noise cancels, and full detail's own difference is 0 by
// construction. With I a frame of the method and R one at full detail, all display-encoded:
//   change: (I_t − I_{t−1}) − (R_t − R_{t−1}). Its RMSE; and the FLIP between I_t and what it should have become,
//           I_{t−1} + (R_t − R_{t−1}), clipped to [0, 1]. Holds whatever the levels get wrong that moves with the
//           camera, pops or not.
//   step:   I_t − the same view and pose at the levels and splits of the frame before: the pop alone.
// What to expect of the step: a whole level's pop is a difference that N samples share, blurred by c px; one sample's
// difference is sharp, w px wide, so that one sample's change is √(c/w)/N of the pop. While fewer samples than one
// change a frame (Δλ·N < 1), fractional levels do all of that in some frames and nothing in the others; continuous
// levels change the share Δλ·N of the sample's pixels in each: √(c/w)·√(Δλ/N), half as much at a quarter of the speed.
// Both over the image and over the objects' pixels: those that an object touches in either frame, its blur included.
//
// Held equal between modes: scene, views, lens samples, thresholds, size, renderer. Layers are 32-bit float unless the
// options say otherwise: their rounding isn't the levels'.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "eval/popping/paths.h"
#include "render/methods.h"

namespace defocus {

inline constexpr std::array poppingModes = {LodMode::nearest, LodMode::fractional, LodMode::continuous};

struct PoppingOptions {
    std::vector<Movement> movements = {Movement::focusPull, Movement::dolly, Movement::turntable};
    std::vector<std::uint32_t> sampleCounts = {8, 16, 32};
    int clip = 0;          // of the scene, for Movement::clip
    int pathFrames = 240;  // that a whole movement takes: how fast it is
    int frames = 48;       // of each movement: the stretch with the most changes of level
    RenderSettings plan;   // what the bench doesn't go through: seed, metric, where the blur is taken, keepAll
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
    LodMode mode = LodMode::off;
    int frame = 0;     // t, 1 or more
    double speed = 0;  // the largest |λ_t − λ_{t−1}| of an object
    Pop change;
    Pop step;
};

// One sample's step against the pop of a whole level, for an object held still: linear RMSEs, over the image.
struct SampleStep {
    std::uint32_t samples = 0;
    std::string object;
    std::uint32_t level = 0;  // the finer of the two
    double coc = 0;           // px, in the middle of the object
    double edgeError = 0;     // px: the deviation of the coarser level
    double expected = 0;      // √(coc/edgeError)/N, where coc > edgeError
    double measured = 0;      // root mean square of all N steps, over the RMSE between the two levels
};

struct PoppingVisitor {
    std::function<void(std::span<const PoppingFrame>)> frames;  // of one movement and number of samples, all modes
    std::function<void(const SampleStep&)> sampleStep;
};

// Needs a current GL context. `world` takes each frame's pose, and has its own again in the end. Throws Error as
// planning, rendering and framesAlong do.
void measurePopping(World& world, const View& view, const PoppingOptions& options, const PoppingVisitor& visitor,
                    const Progress& progress = {});

// 1 where an object is, or within half of its circle of confusion of it; `level` (−1: nothing) and `coc` (px) are those
// of AovImages.
Image objectPixels(const Image& level, const Image& coc);

}  // namespace defocus
