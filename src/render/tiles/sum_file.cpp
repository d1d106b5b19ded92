#include "render/tiles/sum_file.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "plan/render_settings.h"
#include "render/accumulation/layer_sum.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

constexpr const char* firstAttribute = "defocus:firstSample";
constexpr const char* endAttribute = "defocus:endSample";
constexpr const char* frameSamplesAttribute = "defocus:frameSamples";
constexpr const char* secondsAttribute = "defocus:seconds";
constexpr const char* noBlocks = "none";  // placeholder layer of a file without blocks; EXR files need a channel

std::string layerName(std::uint32_t firstSample, const char* what) {
    return fmt::format("samples{:05}.{}", firstSample, what);
}

// Returns whether the alpha of all pixels is `value`.
bool alphaIs(const Image& image, float value) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        if (image.pixels[i] != value) return false;
    return true;
}

Image withoutAlpha(const Image& image) {
    Image result(image.width, image.height, 3);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] = image.pixels[i / 3 * 4 + i % 3];
    return result;
}

Image withAlpha(const Image& image, float alpha) {
    if (image.channels == 4) return image;
    Image result(image.width, image.height, 4);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] = i % 4 == 3 ? alpha : image.pixels[i / 4 * 3 + i % 4];
    return result;
}

// Returns the metadata attribute `name`. Throws Error, with `file` in its message, if it is missing or has another
// type.
template <typename Value>
Value attribute(const Metadata& metadata, const char* name, const std::string& file) {
    const Value* value = attributeOf<Value>(metadata, name);
    if (value == nullptr) fail("{} is not a part of a frame: the attribute '{}' is missing", file, name);
    return *value;
}

std::uint32_t sampleAttribute(const Metadata& metadata, const char* name, const std::string& file) {
    const int value = attribute<int>(metadata, name, file);
    if (value < 0 || value > static_cast<int>(maxSamples))
        fail("{}: the attribute '{}' has the invalid value {}", file, name, value);
    return static_cast<std::uint32_t>(value);
}

struct NamedPart {
    fs::path path;
    FramePart part;
};

// Throws Error unless the sorted parts form a complete frame: no gap, no overlap, equal settings.
void checkComplete(const std::vector<NamedPart>& parts) {
    const FramePart& first = parts.front().part;
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& [path, part] = parts[i];
        if (part.settings != first.settings || part.width != first.width || part.height != first.height ||
            part.frameSamples != first.frameSamples)
            fail("{} and {} belong to different frames: {}", parts.front().path.string(), path.string(),
                 settingsDifference(first.metadata, part.metadata));
        if (part.range.first < next)
            fail("{} and {} overlap: both hold sample {}", parts[i - 1].path.string(), path.string(), part.range.first);
        if (part.range.first > next)
            fail("samples {}:{} of {} are missing before part {}; render them with --sample-range", next,
                 part.range.first, part.frameSamples, path.string());
        next = part.range.end;
    }
    if (next < first.frameSamples)
        fail("samples {}:{} are missing; the frame has {} samples", next, first.frameSamples, first.frameSamples);
}

}  // namespace

void writePart(const fs::path& path, const FramePart& part) {
    std::vector<ImageLayer> layers;
    std::uint32_t first = part.range.first;
    for (const BlockSum& block : part.blocks) {
        const bool opaque = alphaIs(block.sum, static_cast<float>(block.samples)) && alphaIs(block.compensation, 0);
        layers.push_back({layerName(first, "sum"), opaque ? withoutAlpha(block.sum) : block.sum});
        layers.push_back({layerName(first, "lost"), opaque ? withoutAlpha(block.compensation) : block.compensation});
        first += block.samples;
    }
    if (layers.empty()) layers.push_back({noBlocks, Image(part.width, part.height, 3)});
    Metadata metadata = part.metadata;
    metadata[settingsAttribute] = part.settings;
    metadata[firstAttribute] = static_cast<int>(part.range.first);
    metadata[endAttribute] = static_cast<int>(part.range.end);
    metadata[frameSamplesAttribute] = static_cast<int>(part.frameSamples);
    writeLayers(path, layers, metadata);
}

FramePart readPart(const fs::path& path) {
    const std::string file = path.string();
    FramePart part;
    std::vector<ImageLayer> layers = readLayers(path, &part.metadata);
    part.settings = attribute<std::string>(part.metadata, settingsAttribute, file);
    part.range = {sampleAttribute(part.metadata, firstAttribute, file),
                  sampleAttribute(part.metadata, endAttribute, file)};
    part.frameSamples = sampleAttribute(part.metadata, frameSamplesAttribute, file);
    part.width = layers.front().image.width;
    part.height = layers.front().image.height;
    if (part.range.first > part.range.end || part.range.end > part.frameSamples)
        fail("{}: samples {} are outside a frame of {} samples", file, rangeText(part.range), part.frameSamples);
    const bool completeEnd = part.range.end % blockSamples == 0 || part.range.end == part.frameSamples;
    const bool completeFirst = part.range.first % blockSamples == 0 || part.range.first == part.frameSamples;
    if (!completeFirst || !completeEnd)
        fail("{}: the samples {} begin or end within a block of {} samples, so they cannot be merged", file,
             rangeText(part.range), blockSamples);
    for (std::uint32_t first = part.range.first; first < part.range.end; first += blockSamples) {
        const std::uint32_t samples = std::min(blockSamples, part.range.end - first);
        const auto layer = [&](const char* what, float alpha) {
            const auto found = std::ranges::find(layers, layerName(first, what), &ImageLayer::name);
            if (found == layers.end()) fail("{}: the sums of the samples from {} on are missing", file, first);
            return withAlpha(found->image, alpha);
        };
        part.blocks.push_back({samples, layer("sum", static_cast<float>(samples)), layer("lost", 0)});
    }
    for (const char* own : {firstAttribute, endAttribute, frameSamplesAttribute}) part.metadata.erase(own);
    dropFileAttributes(part.metadata);
    return part;
}

MergedFrame mergeParts(const std::vector<fs::path>& paths) {
    // Read all parts and sort them by samples, but do not keep their sums: these are read again below, one part at a
    // time.
    std::vector<NamedPart> parts;
    for (const fs::path& path : paths) {
        parts.push_back({path, readPart(path)});
        parts.back().part.blocks.clear();
    }
    if (parts.empty()) fail("no parts given; name the files written by 'defocus render --sample-range'");
    std::ranges::stable_sort(
        parts, {}, [](const NamedPart& named) { return std::pair(named.part.range.first, named.part.range.end); });
    checkComplete(parts);

    // Add the blocks in sample order.
    MergedFrame merged;
    merged.metadata = parts.front().part.metadata;
    const FramePart& first = parts.front().part;
    if (first.frameSamples == 0) fail("there are no blocks of samples to merge");
    LayerSum sum({.width = first.width, .height = first.height, .format = LayerFormat::rgba16f});
    double seconds = 0;
    for (const NamedPart& named : parts) {
        if (const double* own = attributeOf<double>(named.part.metadata, secondsAttribute)) seconds += *own;
        for (const BlockSum& block : readPart(named.path).blocks) sum.addBlock(block);
    }
    // Set an empty date; otherwise, OpenImageIO would write the current time.
    merged.metadata.try_emplace("capDate", std::string());
    if (merged.metadata.contains(secondsAttribute)) merged.metadata[secondsAttribute] = seconds;
    merged.image = sum.mean();
    return merged;
}

}  // namespace defocus::engine
