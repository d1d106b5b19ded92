#pragma once
// Lens rates: the number of lens samples that share one image of an object (method "multirate" with cells=off). With
// lens cells, sharing is not used: fewer samples give the same quality for all objects (lens_cells.h). A frame that
// doesn't allow cells is drawn without sharing, because sharing increases the error.
//
// An object in focus looks alike from neighbouring lens points. The 64 samples of a block are therefore divided into 16
// groups of 4 neighbours on the lens. Objects with hardly any blur are drawn once per group. Everything else is drawn
// for each sample, composited in depth with the group's image.
//
// Over all blocks, the lens points of the group images are the first samples of the sequence. Each group consists of
// the samples around its image's lens point. Shared objects look as they do in a frame with a quarter of the samples.
// Their error is 4^0.65 times as large, which corresponds to 2.5 times the blur, and it falls with N at the usual rate.
// The mean lens point of each group is not used: the means lie closer to the lens centre and would shrink the disk by 3
// % for any N.
//
// All objects of a sample use the pixel offset of its group. So where a shared object covers an unshared one, only the
// lens point differs. Between touching objects, even this difference would open a gap that shows the background. The
// gap is c/2 times the distance on the lens wide and remains for any N. Therefore touching objects share together or
// not at all (contact.h).
//
// The shared fraction f ∈ [0, 1] of an object follows its largest blur, or that of objects near it. The samples of a
// block are ordered by group (lens_groups.h). A prefix of the groups shares, in the same way as a prefix of the samples
// draws the coarser of two levels. A small change of the blur therefore starts or stops sharing in one group at a time.
// A group whose samples draw different levels draws both levels, each at some pixels (LodMode::continuous).

#include <cstdint>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

inline constexpr std::uint32_t rateBlock = 64;       // samples per block
inline constexpr std::uint32_t minLensGroups = 16;   // per block: the fewest pixel offsets that still smooth an edge
inline constexpr std::uint32_t maxGroupSamples = 4;  // samples per group
// An object is fully shared up to a blur of wholeShareBlur, and not at all from minShareBlur on.
inline constexpr double wholeShareBlur = 3.5;  // px
inline constexpr double minShareBlur = 5;      // px

// Pixels [left, right) × [bottom, top) of the image; row 0 is at the bottom, as in OpenGL.
struct PixelArea {
    int left = 0;
    int bottom = 0;
    int right = 0;
    int top = 0;
    [[nodiscard]] std::int64_t pixels() const { return std::int64_t{right - left} * (top - bottom); }
};

struct ObjectRates {
    double lensShare = 0;  // f, shared fraction of the samples, [0, 1]
    std::string reason;    // reason why the object shares less than its own blur allows; else empty
};

// Rates of all objects of a plan, in the plan's order.
struct FrameRates {
    std::vector<ObjectRates> objects;
    bool shares = false;  // some object shares; only with cells=off
    LensCells cells;
};

// A block of samples, divided into shared and unshared draws for method "multirate".
struct RatedBlock {
    // The block's samples, ordered by group and with their group's pixel offset. Objects have only their unshared
    // draws; an object that all samples share is omitted.
    FramePlan samples;
    // One sample per group, with the objects that the group shares. Group g serves samples [g·groupSize, (g +
    // 1)·groupSize). There are no samples if no object shares.
    FramePlan groups;
    std::uint32_t groupSize = 1;
    std::uint32_t groupsShare = 0;  // groups [0, groupsShare) share at least one object
    // Disjoint areas that contain every pixel of the group images.
    std::vector<PixelArea> sharedAreas;
};

// Returns the group size for a block of `count` samples; 1 if the block is too small to share.
std::uint32_t groupSamples(std::uint32_t count);

// Returns the rates of a plan. With `cells`, images are blurred as lens cells if the frame allows it, and nothing is
// shared. Otherwise objects may share, and nothing is blurred.
FrameRates frameRates(const FramePlan& plan, bool cells = true);

// Returns the mean number of images that multirate draws of an object per sample of `plan`. The mean runs over complete
// blocks and lies between 1/4 (all shared) and 1 (none shared).
double imagesPerSample(const FramePlan& plan, const ObjectRates& rates);

// Returns samples [first, first + count) of `plan` as a block; `first` is a multiple of 64, and `count` ≤ 64. Without
// sharing, every sample draws all objects in the plan's order with its own pixel offset. Sharing is off with
// RenderSettings::keepAll, without a lens, and if no object may share. With lens cells, samples are drawn from the
// middles of their cells, with the pixel shift of FrameRates::cells.
RatedBlock ratedBlock(const FramePlan& plan, const FrameRates& rates, std::uint32_t first, std::uint32_t count);

// Returns the number of triangles that multirate draws for `plan`; FramePlan::trianglesDrawn if nothing is shared.
std::uint64_t ratedTriangles(const FramePlan& plan, const FrameRates& rates);

}  // namespace defocus::engine
