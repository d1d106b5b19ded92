#pragma once
// Lens rates: how many lens samples share one image of an object (method "multirate" with cells=off). With lens cells
// fewer samples do as well for all objects (lens_cells.h), and a frame that doesn't allow cells is drawn as the
// accumulation draws it: what is shared errs more than what each sample draws.
//
// An object in focus looks alike from neighbouring points of the lens. So the samples of each block of 64 are put into
// groups of neighbours on the lens, 16 groups of 4 samples, and what is hardly blurred is drawn once for a group. All
// else is drawn for each sample, in front of and behind what the group shares.
//
// Over all blocks the groups' images are the first samples of the sequence, and each group has the samples around its
// image's lens point. So what is shared looks as it does in a frame of a quarter of the samples: its error is 4^0.65
// times as large as it was, which is that of 2.5 times the blur, and falls with N as ever. Means of the groups' lens
// points, which lie nearer to the lens's middle, would give a disk 3 % too small for any N.
//
// Shared or not, all of a sample is drawn with the pixel offset of its group, so that where an object that is shared
// covers one that isn't, only the lens point differs. Where two objects touch, even that would open a line between them
// through which the background shows: c/2 times the distance on the lens wide, and there for any N. So objects that
// touch share together or not at all (contact.h).
//
// How much of an object is shared is a real number f between 0 and 1 that follows its largest blur, or that of what is
// near it. A block's samples stand in the order of their groups (lens_groups.h), and a prefix of the groups shares, as
// a prefix of the samples draws the coarser of two levels. When the blur changes a little, one group after the other
// begins to share or ceases to. A group whose samples don't all draw the same level draws both, each at its own pixels
// (LodMode::continuous).

#include <cstdint>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "plan/lens_cells/lens_cells.h"

namespace defocus::engine {

inline constexpr std::uint32_t rateBlock = 64;       // samples a block
inline constexpr std::uint32_t minLensGroups = 16;   // of a block: as few pixel offsets still smooth an edge
inline constexpr std::uint32_t maxGroupSamples = 4;  // of a group
// All of an object is shared up to the first diameter of its largest blur, and nothing from the second on.
inline constexpr double wholeShareBlur = 3.5;  // px
inline constexpr double minShareBlur = 5;      // px

// Pixels [left, right) × [bottom, top) of the image; row 0 is at the bottom, as OpenGL has it.
struct PixelArea {
    int left = 0;
    int bottom = 0;
    int right = 0;
    int top = 0;
    [[nodiscard]] std::int64_t pixels() const { return std::int64_t{right - left} * (top - bottom); }
};

struct ObjectRates {
    double lensShare = 0;  // f, of the samples, [0, 1]
    std::string reason;    // why it shares less than its own blur allows; else empty
};

// Of all objects of a plan, in its order.
struct FrameRates {
    std::vector<ObjectRates> objects;
    bool shares = false;  // with cells=off
    LensCells cells;
};

// A block of a frame's samples as multirate draws it.
struct RatedBlock {
    // The block's samples in the order of their groups, with these's pixel offsets, and its objects for the samples
    // that don't share them. One that all samples share isn't there.
    FramePlan samples;
    // As its samples the groups' images, and as its objects what is shared. Group g serves samples [g·groupSize,
    // (g + 1)·groupSize). Without samples if no object shares.
    FramePlan groups;
    std::uint32_t groupSize = 1;
    std::uint32_t groupsShare = 0;  // groups [0, groupsShare) share something
    // Outside these areas no group's image shows anything. They don't overlap.
    std::vector<PixelArea> sharedAreas;
};

// Returns the samples of a group in a block of `count` samples; 1: none is large enough to share.
std::uint32_t groupSamples(std::uint32_t count);

// `cells`: whether images are blurred as lens cells, as far as the frame allows it. Nothing shares then; else nothing
// is blurred.
FrameRates frameRates(const FramePlan& plan, bool cells = true);

// Returns how many images of an object multirate draws for a sample of `plan`, on average over whole blocks: 1 where it
// shares none, down to 1/4.
double imagesPerSample(const FramePlan& plan, const ObjectRates& rates);

// Returns samples [first, first + count) of `plan`, whose rates are `rates`; `first` is a multiple of 64 and `count` ≤
// 64. With RenderSettings::keepAll, without a lens, and where nothing may share, every sample draws everything, in the
// plan's own order and with its own pixel offset. With lens cells it does so from the middle of its cell, with
// FrameRates::cells's shift.
RatedBlock ratedBlock(const FramePlan& plan, const FrameRates& rates, std::uint32_t first, std::uint32_t count);

// Returns the triangles that multirate draws for `plan`; without rates they are FramePlan::trianglesDrawn.
std::uint64_t ratedTriangles(const FramePlan& plan, const FrameRates& rates);

}  // namespace defocus::engine
