#pragma once
// Parts of a frame's lens samples, rendered on several machines and added up afterwards.
//
// The frame's sum adds finished blocks of 64 samples one after the other, each as its value and its compensation
// (render/accumulation/layer_sum.h). A compensated sum isn't associative to the last bit, so a part keeps each of its
// blocks by itself: a layer for the value and one for the compensation, 32-bit float, ZIP. Alpha is left out where the
// background is opaque: it is the number of samples.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image_io.h"
#include "render/renderer.h"

namespace defocus {

// Samples [first, end) of a frame.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

// "64:128". Throws Error unless both are whole numbers, first < end, and first is a multiple of 64.
SampleRange parseSampleRange(std::string_view text);

// Throws Error unless the range ends at a block's border or at the last of `samples`.
void checkSampleRange(const SampleRange& range, std::uint32_t samples);

struct FramePart {
    SampleRange range;               // as far as the frame has samples
    std::uint32_t frameSamples = 0;  // of the whole frame
    std::string settings;            // what the frame is made of; parts of one frame have the same
    int width = 0;
    int height = 0;
    std::vector<BlockSum> blocks;
    Metadata metadata;  // of the whole frame
};

// Draws the samples of `range` of the frame. Throws Error for a method that sums no lens samples.
FramePart renderPart(Renderer& renderer, const FramePlan& plan, const SampleRange& range,
                     const std::function<void()>& step = {});

// `path` ends in .exr. Throw Error naming the file.
void writePart(const std::filesystem::path& path, const FramePart& part);
FramePart readPart(const std::filesystem::path& path);

struct MergedFrame {
    Image image;
    Metadata metadata;
};

// In any order. Throws Error for parts that overlap, are missing, cut a block or are of other settings, naming the
// files. Needs a current GL context.
MergedFrame mergeParts(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus
