#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "image/image_encoding.h"
#include "image/image_io.h"
#include "image/oiio_names.h"
#include "image/packed_pixels.h"

namespace defocus::engine {

namespace {

constexpr int stripRows = 64;  // number of rows that are interleaved at once, for EXR files with layers

void checkImage(const ImageView& image, const std::string& name) {
    const std::size_t values = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0)) *
                               std::size_t(std::max(image.channels, 0));
    if (values == 0 || values != image.pixels.size()) fail("cannot write {}: the image has no pixels", name);
    if (image.channels != 1 && image.channels != 3 && image.channels != 4)
        fail("cannot write {}: the image has {} channels instead of 1, 3 or 4", name, image.channels);
}

}  // namespace

void checkImageExtension(const std::filesystem::path& path) {
    fileKind(path);
}

void writeImage(const std::filesystem::path& path, const ImageView& image, const Metadata& metadata,
                const WriteOptions& options) {
    const FileKind kind = fileKind(path);
    const std::string name = path.string();
    checkImage(image, name);
    const OIIO::ImageSpec spec = imageSpec(kind, image.width, image.height, image.channels, metadata);
    const auto writePixels = [&](OIIO::ImageOutput& output) {
        if (kind == FileKind::exr) return output.write_image(spec.format, image.pixels.data());
        return output.write_image(spec.format, displayBytes(kind, image, options, 0).data());
    };
    const std::vector<unsigned char> bytes = encode("cannot write " + name, formatName(kind), spec, writePixels);
    writeFile(path, std::as_bytes(std::span(bytes)));
}

void writeChannels(const std::filesystem::path& path, const std::vector<NamedChannels>& parts,
                   const Metadata& metadata) {
    const std::string name = path.string();
    if (parts.empty() || fileKind(path) != FileKind::exr) fail("{}: layers can only be written to an .exr file", name);
    const int width = parts.front().image.width;
    const int height = parts.front().image.height;
    std::vector<std::string> channels;
    for (const NamedChannels& part : parts) {
        if (part.image.empty() || part.image.width != width || part.image.height != height)
            fail("cannot write {}: its layers differ in size", name);
        channels.insert(channels.end(), part.names.begin(), part.names.end());
    }
    if (std::set<std::string>(channels.begin(), channels.end()).size() != channels.size())
        fail("cannot write {}: two channels have the same name", name);

    // Interleaves the channels of all images per pixel. Works on strips of rows to save memory.
    const std::size_t stride = channels.size();
    const auto writePixels = [&](OIIO::ImageOutput& output) {
        std::vector<float> strip;
        for (int top = 0; top < height; top += stripRows) {
            const int rows = std::min(stripRows, height - top);
            const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
            strip.resize(pixels * stride);
            std::size_t first = 0;
            for (const NamedChannels& part : parts) {
                const auto count = static_cast<std::size_t>(part.image.channels);
                const float* values = part.image.at(0, top);
                for (std::size_t i = 0; i < pixels * count; ++i)
                    strip[i / count * stride + first + i % count] = values[i];
                first += count;
            }
            if (!output.write_scanlines(top, top + rows, 0, OIIO::TypeFloat, strip.data())) return false;
        }
        return true;
    };
    OIIO::ImageSpec spec = imageSpec(FileKind::exr, width, height, static_cast<int>(stride), metadata);
    spec.channelnames = channels;
    const std::vector<unsigned char> bytes = encode("cannot write " + name, "openexr", spec, writePixels);
    writeFile(path, std::as_bytes(std::span(bytes)));
}

void writeLayers(const std::filesystem::path& path, const std::vector<ImageLayer>& layers, const Metadata& metadata) {
    std::vector<NamedChannels> parts;
    for (const ImageLayer& layer : layers) {
        checkImage(layer.image, path.string());
        NamedChannels& part = parts.emplace_back();
        for (int c = 0; c < layer.image.channels; ++c) part.names.push_back(layer.name + '.' + "RGBA"[c]);
        part.image = layer.image;
    }
    writeChannels(path, parts, metadata);
}

}  // namespace defocus::engine

void defocus::writeImage(const std::filesystem::path& path, const ImageView& image, const WriteOptions& options) {
    engine::writeImage(path, engine::PackedPixels(image).view(), engine::Metadata(), options);
}
