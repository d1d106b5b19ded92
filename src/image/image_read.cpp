#include "image/image_read.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/parallel.h"
#include "image/exr_structure.h"
#include "image/image_io.h"
#include "image/oiio_names.h"
#include "image/packed_pixels.h"
#include "image/png_structure.h"
#include "image/time_code.h"

namespace defocus::engine {

namespace {

// Maximum pixels of an image: 268 million, a 16384 × 16384 texture. A header with a larger size is probably damaged.
constexpr std::uint64_t maximumPixels = 1ull << 28;
// Maximum pixels per byte of a JPEG file. Each block of 8 × 8 px takes at least one bit, so a complete file has at most
// 512; the limit is twice as high. For shorter files, libjpeg would spend a long time filling the missing pixels.
constexpr std::uint64_t maxJpegPixels = 2 * 8 * 8 * 8;

struct Format {
    std::string_view magic;
    const char* name;  // name in OpenImageIO
};
constexpr std::array<Format, 7> formats = {{
    {"\x89PNG\r\n\x1a\n", "png"},
    {"\xff\xd8\xff", "jpeg"},
    {"\x76\x2f\x31\x01", "openexr"},
    {"#?RADIANCE", "hdr"},
    {"#?RGBE", "hdr"},
    {std::string_view("II*\0", 4), "tiff"},
    {std::string_view("MM\0*", 4), "tiff"},
}};

std::optional<std::string_view> formatOf(std::span<const std::byte> encoded) {
    const std::string_view begin(reinterpret_cast<const char*>(encoded.data()),
                                 std::min<std::size_t>(encoded.size(), 16));
    for (const Format& format : formats)
        if (begin.starts_with(format.magic)) return format.name;
    if (begin.starts_with("RIFF") && begin.size() >= 12 && begin.substr(8, 4) == "WEBP") return "webp";
    return std::nullopt;
}

// In-memory file with bounds checks. For damaged files, OpenImageIO's IOMemReader may read before the start of its
// buffer.
class CheckedMemory final : public OIIO::Filesystem::IOMemReader {
public:
    using IOMemReader::IOMemReader;

    size_t read(void* into, size_t count) override {
        const size_t done = pread(into, count, m_pos);
        m_pos += static_cast<int64_t>(done);
        return done;
    }
    size_t pread(void* into, size_t count, int64_t offset) override {
        const auto bytes = buffer();
        const auto size = static_cast<int64_t>(bytes.size());
        if (offset < 0 || offset >= size) return 0;
        const size_t done = std::min(count, static_cast<size_t>(size - offset));
        std::memcpy(into, bytes.data() + offset, done);
        return done;
    }
};

// An opened image reader, and the encoded bytes that it reads.
struct OpenImage {
    std::vector<unsigned char> bytes;
    std::unique_ptr<CheckedMemory> memory;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    bool unchecked = false;  // true: checkPngPixels must check the pixels before they are read
};

OpenImage openImage(std::span<const std::byte> encoded, std::string_view format, const std::string& name) {
    OpenImage image;
    if (format == "png") {
        image.bytes = checkedPng(encoded, name);
        image.unchecked = true;
    } else {
        if (format == "openexr") checkExrHeader(encoded, encoded.size(), name);
        const auto* first = reinterpret_cast<const unsigned char*>(encoded.data());
        image.bytes.assign(first, first + encoded.size());
    }
    image.memory = std::make_unique<CheckedMemory>(image.bytes.data(), image.bytes.size());
    image.input = OIIO::ImageInput::create(std::string(format), false, nullptr, image.memory.get());
    if (!image.input) fail("cannot read {}: {}", name, firstLine(OIIO::geterror()));

    // Read straight alpha: OpenImageIO would premultiply values before they are decoded to linear.
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    image.input->set_ioproxy(image.memory.get());
    {
        // Opening an image decodes its ICC profile. For this, OpenImageIO 2.4 looks up names in a table that all
        // threads share, and inserts unknown names without a lock.
        static std::mutex opening;
        const std::scoped_lock lock(opening);
        if (!image.input->open("image", image.spec, hints))
            fail("cannot read {}: {}", name, firstLine(image.input->geterror()));
    }
    const OIIO::ImageSpec& spec = image.spec;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail("cannot read {}: the image has no pixels", name);
    if (spec.deep) fail("cannot read {}: deep images are not supported", name);
    if (pixelCount(spec.width, spec.height) > maximumPixels)
        fail("cannot read {}: {}x{} pixels exceed the maximum of {} million", name, spec.width, spec.height,
             maximumPixels / 1000000);
    if (format == "jpeg" && pixelCount(spec.width, spec.height) > maxJpegPixels * image.bytes.size())
        fail("cannot read {}: its {} bytes are too few for {}x{} pixels", name, image.bytes.size(), spec.width,
             spec.height);
    return image;
}

// Returns the indices of the file's channels that hold grey, or R, G, B, or R, G, B, A, in this order. In a multi-layer
// file from Blender, these are the channels of the Combined pass.
std::vector<int> colourChannels(const OIIO::ImageSpec& spec, const std::string& name) {
    const auto named = [&](std::string_view channel) {
        auto found = std::ranges::find(spec.channelnames, channel);
        if (found == spec.channelnames.end())
            found = std::ranges::find_if(spec.channelnames, [&](const std::string& each) {
                return each.ends_with(".Combined." + std::string(channel));
            });
        return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
    };
    std::vector<int> channels = {named("R"), named("G"), named("B")};
    if (std::ranges::find(channels, -1) != channels.end()) {
        if (spec.nchannels == 1) return {0};
        if (spec.nchannels == 2 && spec.alpha_channel == 1) return {0, 0, 0, 1};
        if (spec.nchannels != 3 && spec.nchannels != 4)
            fail("cannot read {}: it has {} channels, but none named R, G and B", name, spec.nchannels);
        channels = {0, 1, 2};
    }
    if (const int alpha = named("A"); alpha >= 0)
        channels.push_back(alpha);
    else if (spec.alpha_channel >= 0 && spec.nchannels <= 4)
        channels.push_back(spec.alpha_channel);
    return channels;
}

// Returns the given channels of rows [firstRow, firstRow + rowCount), interleaved.
template <typename T>
std::vector<T> readChannels(OpenImage& image, const std::vector<int>& channels, const std::string& name, int firstRow,
                            int rowCount) {
    if (std::exchange(image.unchecked, false)) checkPngPixels(image.bytes, name);
    const int first = *std::ranges::min_element(channels);
    const int end = *std::ranges::max_element(channels) + 1;
    const std::size_t stride = static_cast<std::size_t>(end - first);
    const std::size_t pixels = std::size_t(image.spec.width) * std::size_t(rowCount);
    std::vector<T> read(pixels * stride);
    const OIIO::TypeDesc type(OIIO::BaseTypeFromC<T>::value);
    const int top = image.spec.y + firstRow;
    const bool complete = rowCount == image.spec.height ? image.input->read_image(0, 0, first, end, type, read.data())
                                                        : image.input->read_scanlines(0, 0, top, top + rowCount, 0,
                                                                                      first, end, type, read.data());
    // For truncated data, libjpeg only warns and fills the missing pixels.
    const std::string message = image.input->geterror();
    if (!complete || message.find("Premature end") != std::string::npos)
        fail("cannot read {}: {}", name, firstLine(message));

    bool allInOrder = channels.size() == stride;
    for (std::size_t c = 0; c < channels.size(); ++c) allInOrder = allInOrder && channels[c] == first + int(c);
    if (allInOrder) return read;
    std::vector<T> chosen(pixels * channels.size());
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < channels.size(); ++c)
            chosen[i * channels.size() + c] = read[i * stride + std::size_t(channels[c] - first)];
    return chosen;
}

// Returns the given channels of all pixels, interleaved.
template <typename T>
std::vector<T> readChannels(OpenImage& image, const std::vector<int>& channels, const std::string& name) {
    return readChannels<T>(image, channels, name, 0, image.spec.height);
}

bool isEncoded(const OIIO::ImageSpec& spec) {
    return !spec.format.is_floating_point() &&
           !OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear");
}

// Converts sRGB values to linear if `encoded`, and straight alpha to premultiplied if `straightAlpha`.
void linearise(Image& image, bool encoded, bool straightAlpha) {
    if (!encoded && !(straightAlpha && image.channels == 4)) return;
    const int colours = std::min(image.channels, 3);
    parallelFor(static_cast<std::size_t>(image.height), [&](std::size_t row) {
        for (int x = 0; x < image.width; ++x) {
            float* pixel = image.at(x, static_cast<int>(row));
            const float coverage = straightAlpha && image.channels == 4 ? pixel[3] : 1.0f;
            for (int c = 0; c < colours; ++c) pixel[c] = coverage * (encoded ? srgbDecode(pixel[c]) : pixel[c]);
        }
    });
}

// Divides colours by alpha. OpenImageIO 2.4 premultiplies WebP images despite the request for straight alpha.
void straighten(TextureImage& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = i; c < i + 3; ++c)
            image.rgba[c] = static_cast<std::uint8_t>(std::min((image.rgba[c] * 255 + alpha / 2) / alpha, 255));
    }
}

// Opened image file whose rows are read as linear, premultiplied colours.
class ColourFile {
public:
    explicit ColourFile(const std::filesystem::path& path) : name_(path.string()) {
        const std::vector<std::byte> encoded = readFile(path);
        if (encoded.empty()) fail("cannot read {}: the file is empty", name_);
        const auto format = formatOf(encoded);
        if (!format) fail("{}: not an image in a known format (PNG, JPEG, WebP, OpenEXR, Radiance HDR, TIFF)", name_);
        file_ = openImage(encoded, *format, name_);
        channels_ = colourChannels(file_.spec, name_);
    }

    [[nodiscard]] const OIIO::ImageSpec& spec() const { return file_.spec; }
    [[nodiscard]] int channels() const { return static_cast<int>(channels_.size()); }
    Image read(int first, int count) {
        Image image;
        image.width = spec().width;
        image.height = count;
        image.channels = channels();
        image.pixels = readChannels<float>(file_, channels_, name_, first, count);
        linearise(image, isEncoded(spec()), spec().get_int_attribute("oiio:UnassociatedAlpha") != 0);
        return image;
    }

private:
    std::string name_;
    OpenImage file_;
    std::vector<int> channels_;
};

std::optional<MetadataValue> metadataValue(const OIIO::ParamValue& attribute) {
    const OIIO::TypeDesc type = attribute.type();
    if (type == OIIO::TypeString) return attribute.get_string();
    if (type == OIIO::TypeInt) return attribute.get_int();
    if (type == OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE)) return *static_cast<const double*>(attribute.data());
    if (type == OIIO::TypeFloat)  // shortest decimal text, so that 1.4f gives 1.4, not 1.39999998
        return std::stod(fmt::format("{}", attribute.get_float()));
    if (type == OIIO::TypeMatrix) {
        glm::mat4 matrix;
        std::memcpy(&matrix, attribute.data(), sizeof matrix);
        return matrix;
    }
    if (type == OIIO::TypeRational) {
        const auto* const parts = static_cast<const int*>(attribute.data());
        return Rational{parts[0], parts[1]};
    }
    if (type == OIIO::TypeTimeCode) return timeCodeOf(*static_cast<const std::uint32_t*>(attribute.data()));
    return std::nullopt;
}

}  // namespace

Metadata metadataOf(const OIIO::ImageSpec& spec) {
    Metadata metadata;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string_view name(attribute.name().c_str(), attribute.name().size());
        if (name.starts_with("oiio:")) continue;
        if (auto value = metadataValue(attribute)) metadata.emplace(exrNameOf(name), std::move(*value));
    }
    return metadata;
}

std::unique_ptr<OIIO::ImageInput> openExr(const std::filesystem::path& path, OIIO::ImageSpec& spec,
                                          std::size_t headBytes) {
    const std::string name = path.string();
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status))
        static_cast<void>(readFile(path));  // throws Error with the reason if the file is unreadable
    checkExrHeader(path, headBytes);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("openexr");
    if (!input) fail("cannot read {}: {}", name, firstLine(OIIO::geterror()));
    if (!input->open(name, spec)) fail("cannot read {}: {}", name, firstLine(input->geterror()));
    return input;
}

struct StripReader::State {
    int width = 0;
    int height = 0;
    int channels = 0;
    bool tiled = false;
    std::function<Image(int first, int count)> read;
    Image strip;    // rows that rows() returned last; the complete image if the file has tiles
    int begin = 0;  // index in the image of the first row of `strip`
};

StripReader::StripReader(const std::filesystem::path& path) {
    const auto file = std::make_shared<ColourFile>(path);
    const OIIO::ImageSpec& spec = file->spec();
    const auto read = [file](int first, int count) { return file->read(first, count); };
    state_ = std::make_unique<State>(State{spec.width, spec.height, file->channels(), spec.tile_width > 0, read, {}});
}
StripReader::~StripReader() = default;
StripReader::StripReader(StripReader&&) noexcept = default;

int StripReader::width() const {
    return state_->width;
}

int StripReader::height() const {
    return state_->height;
}

ImageView StripReader::rows(int first, int count) {
    State& s = *state_;
    if (s.tiled && s.strip.empty()) s.strip = s.read(0, s.height);
    if (s.tiled) return rowsOf(s.strip, first, count);

    // Move the rows that the old and the new strip share to the front, then append the other rows of the new strip.
    const int end = s.begin + s.strip.height;
    assert(first >= s.begin && first <= end && count >= 1 && first + count <= s.height);
    const int kept = std::min(count, end - first);
    Image strip(s.width, count, s.channels);
    const ImageView shared = rowsOf(s.strip, first - s.begin, kept);
    std::ranges::copy(shared.pixels, strip.pixels.begin());
    if (kept < count) std::ranges::copy(s.read(end, count - kept).pixels, strip.at(0, kept));
    s.strip = std::move(strip);
    s.begin = first;
    return s.strip;
}

Image readImage(const std::filesystem::path& path, Metadata& metadata) {
    ColourFile file(path);
    metadata = metadataOf(file.spec());
    return file.read(0, file.spec().height);
}

std::vector<ImageLayer> readLayers(const std::filesystem::path& path, Metadata* metadata) {
    const std::string name = path.string();
    const std::vector<std::byte> encoded = readFile(path);
    if (formatOf(encoded) != "openexr") fail("{}: not an EXR file with layers", name);
    OpenImage file = openImage(encoded, "openexr", name);

    // Group channels by layer.
    std::map<std::string, std::vector<int>> channels;  // indices of R, G, B, A by layer name; −1 if missing
    const std::vector<std::string>& names = file.spec.channelnames;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::size_t dot = names[i].rfind('.');
        const std::size_t place =
            dot == std::string::npos ? dot : std::string_view("RGBA").find(names[i].substr(dot + 1));
        if (place == std::string::npos)
            fail("{}: not an EXR file with layers: the channel '{}' belongs to no layer", name, names[i]);
        std::vector<int>& layer = channels.try_emplace(names[i].substr(0, dot), 4, -1).first->second;
        layer[place] = static_cast<int>(i);
    }

    std::vector<ImageLayer> layers;
    for (auto& [layerName, places] : channels) {
        if (places[3] < 0) places.pop_back();
        if (std::ranges::find(places, -1) != places.end())
            fail("{}: the layer '{}' lacks at least one of the channels R, G and B", name, layerName);
        Image image(file.spec.width, file.spec.height, static_cast<int>(places.size()));
        image.pixels = readChannels<float>(file, places, name);
        layers.push_back({layerName, std::move(image)});
    }
    if (metadata != nullptr) *metadata = metadataOf(file.spec);
    return layers;
}

TextureImage decodeTexture(std::span<const std::byte> encoded, const std::string& name,
                           const std::function<void(std::uint64_t pixels)>& take) {
    const auto format = formatOf(encoded);
    if (format != "png" && format != "jpeg" && format != "webp") fail("{}: not a PNG, JPEG or WebP image", name);
    OpenImage file = openImage(encoded, *format, name);
    if (take) take(pixelCount(file.spec.width, file.spec.height));
    std::vector<int> channels = colourChannels(file.spec, name);
    if (channels.size() == 1) channels.resize(3, channels[0]);
    const std::vector<std::uint8_t> values = readChannels<std::uint8_t>(file, channels, name);

    TextureImage texture{file.spec.width, file.spec.height, {}};
    const std::size_t pixels = values.size() / channels.size();
    texture.rgba.assign(pixels * 4, 255);
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(values.data() + i * channels.size(), channels.size(), texture.rgba.data() + i * 4);
    if (format == "webp") straighten(texture);
    return texture;
}

}  // namespace defocus::engine

defocus::Image defocus::readImage(const std::filesystem::path& path) {
    engine::Metadata unused;
    return engine::readImage(path, unused);
}
