#pragma once
// Writes and merges files with the sums of a range of lens samples of a frame.
//
// A frame's sum is the sum of its blocks of 64 samples, added in order (render/accumulation/layer_sum.h). Compensated
// sums are not exactly associative, so a file stores each block separately, in two layers: value and compensation,
// 32-bit float, ZIP. Alpha is omitted for opaque backgrounds, where it equals the number of samples.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/tiles/part_header.h"

namespace defocus::engine {

struct FramePart {
    SampleRange range;               // samples in the file, clamped to the frame's samples
    std::uint32_t frameSamples = 0;  // samples of the full frame
    std::string settings;            // settings of the frame, equal for all parts
    int width = 0;
    int height = 0;
    std::vector<BlockSum> blocks;
    Metadata metadata;  // metadata of the full frame
};

// `path` must end in .exr. writePart() and readPart() throw Error, with the path in its message, if the file cannot be
// written or read.
void writePart(const std::filesystem::path& path, const FramePart& part);
FramePart readPart(const std::filesystem::path& path);

struct MergedFrame {
    Image image;
    Metadata metadata;
};

// Merges the files of one frame, given in any order. Throws Error, with the paths in its message, if sample ranges
// overlap or leave gaps, if a range splits a block of 64 samples, or if settings differ. Needs a current OpenGL
// context.
MergedFrame mergeParts(const std::vector<std::filesystem::path>& paths);

}  // namespace defocus::engine
