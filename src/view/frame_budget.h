#pragma once
// How much a frame may cost while things move: a ladder of qualities, each about twice as dear as the one below, and a
// hand that climbs and descends it so that frames keep to their time.

#include <cstddef>
#include <cstdint>
#include <span>

namespace defocus {

struct FrameQuality {
    double resolution = 1;       // internal pixels a side to one of the window
    std::uint32_t samples = 64;  // 1: without blur
    double thresholdBias = 1;    // factor on the level-of-detail thresholds: coarser meshes
};

// From the cheapest to the best.
std::span<const FrameQuality> frameQualities();

struct FrameBudget {
    double milliseconds = 16;  // that a frame may take
    std::size_t rung = 3;      // into frameQualities
    [[nodiscard]] const FrameQuality& quality() const { return frameQualities()[rung]; }
};

// The budget with the rung for the next frame, after one on the present rung took `measured` ms: down at once by as
// many rungs as it was too slow, up one rung when even twice the cost would fit. In between it stays: no flicker.
FrameBudget adapted(FrameBudget budget, double measured);

}  // namespace defocus
