#pragma once
// Files that hold the sums of some lens samples of a frame.
//
// The frame's sum adds finished blocks of 64 samples one after the other, each as its value and its compensation
// (render/accumulation/layer_sum.h). A compensated sum isn't associative to the last bit, so a file keeps each of its
// blocks: one layer for the value and one for the compensation, 32-bit float, ZIP. Alpha is left out where the
// background is opaque: there it equals the number of samples.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct FramePart {
    SampleRange range;               // clipped to the frame's samples
    std::uint32_t frameSamples = 0;  // of the whole frame
    std::string settings;            // what the frame is made of; equal for the parts of one frame
    int width = 0;
    int height = 0;
    std::vector<BlockSum> blocks;
    Metadata metadata;  // of the whole frame
};

// `path` ends in .exr. Both throw Error naming the file.
void writePart(const std::filesystem::path& path, const FramePart& part);
FramePart readPart(const std::filesystem::path& path);

struct MergedFrame {
    Image image;
    Metadata metadata;
};

// Merges the parts of one frame, given in any order. Throws Error naming the files for parts that overlap, are missing,
// cut a block or have other settings. Needs a current GL context.
MergedFrame mergeParts(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus::engine
