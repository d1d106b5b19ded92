#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "image/image_io.h"
#include "image/oiio_names.h"
#include "image/quantise.h"

namespace defocus {

namespace {

enum class FileKind { exr, png, jpeg };

FileKind fileKind(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (extension == ".exr") return FileKind::exr;
    if (extension == ".png") return FileKind::png;
    if (extension == ".jpg" || extension == ".jpeg") return FileKind::jpeg;
    fail("{}: unknown image type \"{}\"; use .exr, .png, .jpg or .jpeg", path.string(), extension);
}

void checkImage(const ImageView& image, const std::string& name) {
    const std::size_t values = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0)) *
                               std::size_t(std::max(image.channels, 0));
    if (values == 0 || values != image.pixels.size()) fail("{}: cannot be written: the image has no pixels", name);
    if (image.channels != 1 && image.channels != 3 && image.channels != 4)
        fail("{}: cannot be written: the image has {} channels instead of 1, 3 or 4", name, image.channels);
}

Image copyOf(const ImageView& view) {
    Image image(view.width, view.height, view.channels);
    std::ranges::copy(view.pixels, image.pixels.begin());
    return image;
}

// Colours divided by their coverage; where nothing covers, nothing can be stored.
Image withStraightAlpha(const ImageView& premultiplied) {
    Image image = copyOf(premultiplied);
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        float* pixel = image.pixels.data() + i;
        const float scale = pixel[3] > 0 ? 1 / std::min(pixel[3], 1.0f) : 0.0f;
        for (int c = 0; c < 3; ++c) pixel[c] *= scale;
    }
    return image;
}

Image withoutAlpha(const ImageView& image) {
    Image opaque(image.width, image.height, 3);
    for (std::size_t i = 0; i < opaque.pixels.size() / 3; ++i)
        std::copy_n(image.pixels.data() + 4 * i, 3, opaque.pixels.data() + 3 * i);
    return opaque;
}

// Adds the metadata in EXR's types, or as text for PNG, which has no other.
struct MetadataWriter {
    OIIO::ImageSpec& spec;
    FileKind kind;
    std::string name;

    void operator()(int value) const {
        if (kind == FileKind::png) return (*this)(std::to_string(value));
        spec.attribute(oiioNameOf(name), value);
    }
    void operator()(double value) const {
        if (kind == FileKind::png) return (*this)(fmt::format("{}", value));
        const bool standard = name.find(':') == std::string::npos;
        if (standard)
            spec.attribute(oiioNameOf(name), static_cast<float>(value));
        else
            spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE), &value);
    }
    void operator()(const std::string& value) const {
        spec.attribute(kind == FileKind::png ? name : oiioNameOf(name), value);
    }
    void operator()(const glm::mat4& value) const {
        if (kind != FileKind::png) spec.attribute(oiioNameOf(name), OIIO::TypeMatrix, &value);
    }
};

// The whole file in memory: a library's late or silent write errors can't happen, and the disk sees one plain write.
std::vector<unsigned char> encode(const std::string& name, const char* format, const OIIO::ImageSpec& spec,
                                  const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &memory);
    if (!output) fail("{}: cannot be written: {}", name, firstLine(OIIO::geterror()));
    output->set_ioproxy(&memory);
    if (!output->open("image", spec) || !output->write_image(spec.format, pixels) || !output->close())
        fail("{}: cannot be written: {}", name, firstLine(output->geterror()));
    return bytes;
}

std::vector<unsigned char> encodeExr(const std::string& name, const ImageView& image, const Metadata& metadata) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [attribute, value] : metadata) std::visit(MetadataWriter{spec, FileKind::exr, attribute}, value);
    return encode(name, "openexr", spec, image.pixels.data());
}

std::vector<unsigned char> encodePng(const std::string& name, const ImageView& image, const Metadata& metadata,
                                     const WriteOptions& options) {
    const Image display = displayEncoded(image.channels == 4 ? ImageView(withStraightAlpha(image)) : image,
                                         options.toneMap, options.exposure);
    OIIO::ImageSpec spec(display.width, display.height, display.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    for (const auto& [attribute, value] : metadata) std::visit(MetadataWriter{spec, FileKind::png, attribute}, value);
    return encode(name, "png", spec, quantised(display).data());
}

std::vector<unsigned char> encodeJpeg(const std::string& name, const ImageView& image, const Metadata& metadata,
                                      const WriteOptions& options) {
    const Image display =
        displayEncoded(image.channels == 4 ? ImageView(withoutAlpha(image)) : image, options.toneMap, options.exposure);
    OIIO::ImageSpec spec(display.width, display.height, display.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Compression", "jpeg:95");
    if (const auto comments = metadata.find("comments"); comments != metadata.end())
        std::visit(MetadataWriter{spec, FileKind::jpeg, comments->first}, comments->second);
    return encode(name, "jpeg", spec, quantised(display).data());
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
    const std::vector<unsigned char> bytes = kind == FileKind::exr   ? encodeExr(name, image, metadata)
                                             : kind == FileKind::png ? encodePng(name, image, metadata, options)
                                                                     : encodeJpeg(name, image, metadata, options);
    writeFile(path, std::as_bytes(std::span(bytes)));
}

void writeImage(const std::filesystem::path& path, const ImageView& image, const WriteOptions& options) {
    writeImage(path, image, {}, options);
}

void writeLayers(const std::filesystem::path& path, const std::vector<ImageLayer>& layers, const Metadata& metadata) {
    const std::string name = path.string();
    if (layers.empty() || fileKind(path) != FileKind::exr) fail("{}: layers are written to .exr files", name);
    const int width = layers.front().image.width;
    const int height = layers.front().image.height;
    std::vector<std::string> channels;
    for (const ImageLayer& layer : layers) {
        checkImage(layer.image, name);
        if (layer.image.width != width || layer.image.height != height)
            fail("{}: cannot be written: its layers differ in size", name);
        for (int c = 0; c < layer.image.channels; ++c) channels.push_back(layer.name + '.' + "RGBA"[c]);
    }

    // Pixel by pixel, the channels of all layers.
    const std::size_t stride = channels.size();
    std::vector<float> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * stride);
    std::size_t first = 0;
    for (const ImageLayer& layer : layers) {
        const auto count = static_cast<std::size_t>(layer.image.channels);
        for (std::size_t i = 0; i < layer.image.pixels.size(); ++i)
            pixels[i / count * stride + first + i % count] = layer.image.pixels[i];
        first += count;
    }
    OIIO::ImageSpec spec(width, height, static_cast<int>(stride), OIIO::TypeFloat);
    spec.channelnames = channels;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [attribute, value] : metadata) std::visit(MetadataWriter{spec, FileKind::exr, attribute}, value);
    const std::vector<unsigned char> bytes = encode(name, "openexr", spec, pixels.data());
    writeFile(path, std::as_bytes(std::span(bytes)));
}

}  // namespace defocus
