#pragma once
// Parts of a frame that are rendered separately and joined into one image: some rows with all lens samples
// (row_file.h), or the sums of some lens samples (sum_file.h).
//
// Both are EXR files. Their metadata hold the frame's settings ("defocus:settings") and the part of the frame in the
// file.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "image/image_io.h"

namespace defocus::engine {

// Name of the metadata attribute with the frame's settings as text; equal for all parts of one frame.
inline constexpr const char* settingsAttribute = "defocus:settings";

// Lens samples [first, end) of a frame.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

// Returns text such as "64:128".
std::string rangeText(const SampleRange& range);

// Parses "64:128". Throws Error unless both are integers, first < end, and first is a multiple of 64.
SampleRange parseSampleRange(std::string_view text);

// Throws Error unless the range ends at the border of a block of 64 samples or at the last of `samples`.
void checkSampleRange(const SampleRange& range, std::uint32_t samples);

// Share `index` (0 … count − 1) of a frame's rows.
struct TileShare {
    int index = 0;
    int count = 1;
};

// Parses text such as "1/4". Throws Error for other text.
TileShare parseTileShare(std::string_view text);

// Returns a text attribute; null if there is none of this name.
const std::string* textAttribute(const Metadata& metadata, const char* name);

// Removes attributes of the file format (compression, windows, …), which don't describe the frame.
void dropFileAttributes(Metadata& metadata);

}  // namespace defocus::engine
