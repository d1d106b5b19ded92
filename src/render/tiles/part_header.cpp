#include "render/tiles/part_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "defocus/settings.h"
#include "plan/render_settings.h"

namespace defocus::engine {

namespace {

// Returns a number or string as text; "" for other types.
std::string valueText(const MetadataValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* integer = std::get_if<int>(&value)) return fmt::format("{}", *integer);
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:g}", *number);
    return {};
}

}  // namespace

std::string rangeText(const SampleRange& range) {
    return fmt::format("{}:{}", range.first, range.end);
}

SampleRange parseSampleRange(std::string_view text) {
    const auto number = [&](std::string_view part) {
        const std::optional<std::uint32_t> value = parsedNumber<std::uint32_t>(part);
        if (!value || *value > maxSamples)
            fail("'{}' is not a range of samples; give FIRST:END between 0 and {}, such as 64:128", text, maxSamples);
        return *value;
    };
    const std::size_t colon = std::min(text.find(':'), text.size());
    const SampleRange range{number(text.substr(0, colon)), number(text.substr(std::min(colon + 1, text.size())))};
    if (range.first >= range.end) fail("'{}': the range has no samples", text);
    if (range.first % blockSamples != 0)
        fail("'{}' splits a block of {} samples; let the range begin at a multiple of {}", text, blockSamples,
             blockSamples);
    return range;
}

void checkSampleRange(const SampleRange& range, std::uint32_t samples) {
    if (range.end > samples)
        fail("samples {} are out of range: the frame has only {} (--samples)", rangeText(range), samples);
    if (range.end % blockSamples != 0 && range.end != samples)
        fail("samples {} split a block of {} samples; end at a multiple of {} or with the last sample, {}",
             rangeText(range), blockSamples, blockSamples, samples);
}

Share parseTileShare(std::string_view text) {
    return parseShare(text, "tile", maxImageSide);
}

std::string settingsDifference(const Metadata& first, const Metadata& second) {
    static constexpr std::string_view prefix = "defocus:";
    // Attributes that are not reported as differing settings: attributes that describe a part instead of the frame, and
    // thresholds, which by default follow from other settings.
    static constexpr std::string_view ignored[] = {"settings", "firstSample",   "endSample",     "seconds",
                                                   "device",   "blurThreshold", "sizeThreshold", "lightThreshold"};
    constexpr int maxNamed = 3;
    std::string text;
    int named = 0;
    for (const auto& [name, value] : first) {
        const auto other = second.find(name);
        if (!name.starts_with(prefix) || other == second.end() || other->second == value) continue;
        const std::string_view setting = std::string_view(name).substr(prefix.size());
        const std::string one = valueText(value), two = valueText(other->second);
        if (one == two || named == maxNamed || std::ranges::find(ignored, setting) != std::end(ignored)) continue;
        text += fmt::format("{}{} differs ({} and {})", named++ == 0 ? "" : ", ", setting, one, two);
    }
    return named == 0 ? "their settings differ" : text;
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
