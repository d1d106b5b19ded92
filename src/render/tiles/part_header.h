#pragma once
// Reads and checks the headers of files with a part of a frame: a range of rows with all lens samples (row_file.h), or
// the sums of a range of lens samples (sum_file.h). The parts are rendered separately and joined into one image.
//
// Both kinds of file are EXR files whose metadata contain the frame's settings ("defocus:settings") and the range of
// rows or samples.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/parse.h"
#include "image/image_io.h"

namespace defocus::engine {

// Name of the metadata attribute that holds the frame's settings as text. The text is equal in all parts of one frame.
inline constexpr const char* settingsAttribute = "defocus:settings";

// Range [first, end) of a frame's lens samples.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

// Returns "first:end", e.g. "64:128".
std::string rangeText(const SampleRange& range);

// Parses "first:end", e.g. "64:128". Throws Error unless both are integers, first < end, and first is a multiple of 64.
SampleRange parseSampleRange(std::string_view text);

// Throws Error unless the end of the range is a multiple of 64 or equals `samples`, the number of samples of the frame.
void checkSampleRange(const SampleRange& range, std::uint32_t samples);

// Parses "index/count", a share of a frame's rows. Throws Error unless both are integers and 0 ≤ index < count.
Share parseTileShare(std::string_view text);

// Returns the settings that differ between two parts' metadata, such as "seed differs (0 and 1)": at most three,
// separated by commas. Returns "their settings differ" if no differing setting can be named from the metadata.
std::string settingsDifference(const Metadata& first, const Metadata& second);

// Removes attributes that describe the file (compression, windows, …) instead of the frame.
void dropFileAttributes(Metadata& metadata);

}  // namespace defocus::engine
