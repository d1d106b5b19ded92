#include "render/tiles/part_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "core/error.h"
#include "core/parse.h"
#include "defocus/settings.h"
#include "render/gpu_scene/frame_uniforms.h"

namespace defocus::engine {

std::string rangeText(const SampleRange& range) {
    return fmt::format("{}:{}", range.first, range.end);
}

SampleRange parseSampleRange(std::string_view text) {
    const auto number = [&](std::string_view part) {
        std::uint32_t value = 0;
        const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (fault != std::errc() || end != part.data() + part.size() || value > maxSamples)
            fail("'{}' is not FIRST:END, with samples from 0 to {}, such as 64:128", text, maxSamples);
        return value;
    };
    const std::size_t colon = std::min(text.find(':'), text.size());
    const SampleRange range{number(text.substr(0, colon)), number(text.substr(std::min(colon + 1, text.size())))};
    if (range.first >= range.end) fail("'{}': the range has no samples", text);
    if (range.first % blockSamples != 0)
        fail("'{}' splits a block of {} samples; begin at a multiple of {}", text, blockSamples, blockSamples);
    return range;
}

void checkSampleRange(const SampleRange& range, std::uint32_t samples) {
    if (range.end > samples) fail("samples {}: the frame has only {} (--samples)", rangeText(range), samples);
    if (range.end % blockSamples != 0 && range.end != samples)
        fail("samples {} split a block of {} samples; end at a multiple of {} or with the last sample, {}",
             rangeText(range), blockSamples, blockSamples, samples);
}

TileShare parseTileShare(std::string_view text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    TileShare share;
    try {
        share.index = static_cast<int>(parseInteger(std::string(text.substr(0, slash)), 0, maxImageSide - 1));
        share.count =
            static_cast<int>(parseInteger(std::string(text.substr(std::min(slash + 1, text.size()))), 1, maxImageSide));
    } catch (const Error&) {
        fail("'{}' is not I/N, such as 0/4: tile I (0 to N-1) of N", text);
    }
    if (share.index >= share.count)
        fail("'{}': with {} tiles, the tile must be 0 to {} (Slurm: --array=0-{})", text, share.count, share.count - 1,
             share.count - 1);
    return share;
}

const std::string* textAttribute(const Metadata& metadata, const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
}

void dropFileAttributes(Metadata& metadata) {
    std::erase_if(metadata, [](const auto& entry) {
        static constexpr std::string_view ofFile[] = {
            "compression", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth",
            "name",        "chunkCount",       "PixelAspectRatio",   "version"};
        return entry.first.starts_with("openexr:") || entry.first.starts_with("oiio:") ||
               std::ranges::find(ofFile, entry.first) != std::end(ofFile);
    });
}

}  // namespace defocus::engine
