#include "image/image_encoding.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/source_date.h"
#include "image/oiio_names.h"
#include "image/quantise.h"
#include "image/time_code.h"

namespace defocus::engine {

namespace {

Image copyOf(const ImageView& view) {
    Image image(view.width, view.height, view.channels);
    std::ranges::copy(view.pixels, image.pixels.begin());
    return image;
}

// Returns an RGBA image with its colours divided by alpha; pixels with alpha 0 become black.
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

// CIE xy chromaticities (x, then y) of red, green, blue and the white point D65 of Rec. ITU-R BT.709.
constexpr std::array<float, 8> rec709 = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Adds one metadata value to `spec`, as text for PNG and with its EXR type for EXR.
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
    void operator()(const Rational& value) const {
        const std::array<int, 2> parts = {value.numerator, value.denominator};
        if (kind == FileKind::png) return (*this)(fmt::format("{}/{}", parts[0], parts[1]));
        spec.attribute(oiioNameOf(name), OIIO::TypeRational, parts.data());
    }
    void operator()(const TimeCode& value) const {
        const std::array<int, 4> parts = {value.hours, value.minutes, value.seconds, value.frame};
        if (kind == FileKind::png)
            return (*this)(fmt::format("{:02}:{:02}:{:02}:{:02}", parts[0], parts[1], parts[2], parts[3]));
        const std::array<std::uint32_t, 2> bits = {timeCodeBits(value), 0};
        spec.attribute(oiioNameOf(name), OIIO::TypeTimeCode, bits.data());
    }
};

}  // namespace

bool isExr(const std::filesystem::path& path) {
    return OIIO::Strutil::iequals(path.extension().string(), ".exr");
}

FileKind fileKind(const std::filesystem::path& path) {
    const std::string extension = OIIO::Strutil::lower(path.extension().string());
    if (isExr(path)) return FileKind::exr;
    if (extension == ".png") return FileKind::png;
    if (extension == ".jpg" || extension == ".jpeg") return FileKind::jpeg;
    fail("{}: unknown image type \"{}\"; use .exr, .png, .jpg or .jpeg", path.string(), extension);
}

const char* formatName(FileKind kind) {
    return kind == FileKind::exr ? "openexr" : kind == FileKind::png ? "png" : "jpeg";
}

OIIO::ImageSpec imageSpec(FileKind kind, int width, int height, int channels, const Metadata& metadata) {
    const bool floats = kind == FileKind::exr;
    const int kept = kind == FileKind::jpeg && channels == 4 ? 3 : channels;
    OIIO::ImageSpec spec(width, height, kept, floats ? OIIO::TypeFloat : OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", floats ? "Linear" : "sRGB");
    if (kind == FileKind::exr) {
        spec.attribute("compression", "zip");
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709.data());
    }
    if (kind == FileKind::png) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (kind == FileKind::jpeg) spec.attribute("Compression", "jpeg:95");
    for (const auto& [attribute, value] : metadata)
        if (kind != FileKind::jpeg || attribute == "comments") std::visit(MetadataWriter{spec, kind, attribute}, value);
    // OpenImageIO adds the current time to an EXR file without a date.
    if (const std::optional<std::time_t> date = sourceDate();
        date && kind == FileKind::exr && !metadata.contains("capDate"))
        spec.attribute(oiioNameOf("capDate"), utcText(*date, "%Y:%m:%d %H:%M:%S"));
    return spec;
}

std::vector<std::uint8_t> displayBytes(FileKind kind, const ImageView& image, const WriteOptions& options,
                                       int firstRow) {
    const auto display = [&](const ImageView& linear) {
        return quantised(displayEncoded(linear, options.toneMap, options.exposure), firstRow);
    };
    if (image.channels != 4) return display(image);
    return display(kind == FileKind::png ? withStraightAlpha(image) : withoutAlpha(image));
}

std::vector<unsigned char> encode(const std::string& failure, const char* format, const OIIO::ImageSpec& spec,
                                  const std::function<bool(OIIO::ImageOutput&)>& writePixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &memory);
    if (!output) fail("{}: {}", failure, firstLine(OIIO::geterror()));
    output->set_ioproxy(&memory);
    if (!output->open("image", spec) || !writePixels(*output) || !output->close())
        fail("{}: {}", failure, firstLine(output->geterror()));
    return bytes;
}

}  // namespace defocus::engine
