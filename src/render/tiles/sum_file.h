#pragma once
// Files with the sums of some lens samples of a frame.
//
// The frame's sum adds finished blocks of 64 samples in order, each as value and compensation
// (render/accumulation/layer_sum.h). Compensated sums are not associative to the last bit, so a file stores each block
// separately: one layer for the value and one for the compensation, 32-bit float, ZIP. Alpha is omitted for opaque
// backgrounds, where it equals the number of samples.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct FramePart {
    SampleRange range;               // clipped to the frame's samples
    std::uint32_t frameSamples = 0;  // samples of the full frame
    std::string settings;            // settings of the frame; equal for all parts
    int width = 0;
    int height = 0;
    std::vector<BlockSum> blocks;
    Metadata metadata;  // metadata of the full frame
};

// `path` must end in .exr. Both functions throw Error naming the file.
void writePart(const std::filesystem::path& path, const FramePart& part);
FramePart readPart(const std::filesystem::path& path);

struct MergedFrame {
    Image image;
    Metadata metadata;
};

// Merges the parts of one frame, in any order. Throws Error naming the files if parts overlap, are missing, cut a block
// or differ in settings. Needs a current GL context.
MergedFrame mergeParts(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus::engine
