#include "image/image_parts.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "image/exr_structure.h"
#include "image/image_encoding.h"
#include "image/image_read.h"
#include "image/oiio_names.h"

namespace defocus::engine {

namespace {

const std::vector<std::string> channelNames = {"R", "G", "B", "A", "Z"};
constexpr int depthChannel = 4;
constexpr std::uint64_t maxPixels = 1ull << 28;          // max pixels of one part of a multi-part file
constexpr std::size_t headBytes = std::size_t{8} << 20;  // bytes read to check the headers; enough for 1024 parts

OIIO::ImageSpec partSpec(const PartSize& size, const Metadata& metadata, std::size_t part) {
    OIIO::ImageSpec spec = imageSpec(FileKind::exr, size.fullWidth(), size.fullHeight(), 5, metadata);
    spec.x = spec.y = -size.margin;
    spec.full_x = spec.full_y = 0;
    spec.full_width = size.width;
    spec.full_height = size.height;
    spec.channelnames = channelNames;
    spec.channelformats.assign(4, OIIO::TypeHalf);
    spec.channelformats.push_back(OIIO::TypeFloat);
    spec.alpha_channel = 3;
    spec.z_channel = depthChannel;
    spec.attribute("oiio:subimagename", fmt::format("lens{:04}", part));
    return spec;
}

}  // namespace

struct ImagePartWriter::State {
    explicit State(const std::filesystem::path& path) : name(path.string()), pending(path) {}

    [[noreturn]] void failed() { fail("cannot write {}: {}", name, firstLine(output->geterror())); }

    std::string name;
    PendingFile pending;
    std::unique_ptr<OIIO::ImageOutput> output;
    std::vector<OIIO::ImageSpec> specs;
    std::size_t written = 0;
    std::vector<float> pixels;  // channels R, G, B, A and Z of one part, interleaved
};

ImagePartWriter::ImagePartWriter(const std::filesystem::path& path, const PartSize& size,
                                 const std::vector<Metadata>& parts)
    : state_(std::make_unique<State>(path)) {
    assert(!parts.empty() && parts.size() <= maxImageParts);
    State& s = *state_;
    for (const Metadata& metadata : parts) s.specs.push_back(partSpec(size, metadata, s.specs.size()));
    s.output = OIIO::ImageOutput::create("openexr");
    if (!s.output) fail("cannot write {}: {}", s.name, firstLine(OIIO::geterror()));
    if (!s.output->open(s.pending.temporaryPath().string(), static_cast<int>(s.specs.size()), s.specs.data()))
        s.failed();
}

ImagePartWriter::~ImagePartWriter() = default;
ImagePartWriter::ImagePartWriter(ImagePartWriter&&) noexcept = default;

void ImagePartWriter::write(const ImageView& colour, const ImageView& depth) {
    State& s = *state_;
    const OIIO::ImageSpec& spec = s.specs[s.written];
    assert(s.written < s.specs.size() && colour.channels == 4 && depth.channels == 1);
    assert(colour.width == spec.width && colour.height == spec.height &&
           depth.pixels.size() * 4 == colour.pixels.size());
    s.pixels.resize(depth.pixels.size() * channelNames.size());
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c)
            s.pixels[5 * i + c] = std::clamp(colour.pixels[4 * i + c], -maxHalf, maxHalf);
        s.pixels[5 * i + 4] = depth.pixels[i];
    }
    if (s.written > 0 && !s.output->open(s.pending.temporaryPath().string(), spec, OIIO::ImageOutput::AppendSubimage))
        s.failed();
    if (!s.output->write_image(OIIO::TypeFloat, s.pixels.data())) s.failed();
    ++s.written;
}

void ImagePartWriter::finish() {
    State& s = *state_;
    assert(s.written == s.specs.size());
    if (!s.output->close()) s.failed();
    s.output.reset();
    s.pending.commit();
}

struct ImagePartReader::State {
    // Reads channels [first, first + count) of a part of the file to `pixels`.
    void read(std::size_t part, int first, int count, OIIO::TypeDesc type, void* pixels) {
        if (!input->read_image(static_cast<int>(part), 0, first, first + count, type, pixels))
            fail("cannot read {}: image {}: {}", name, part, firstLine(input->geterror()));
    }

    std::string name;
    std::unique_ptr<OIIO::ImageInput> input;
    PartSize size;
    std::vector<Metadata> metadata;
};

ImagePartReader::ImagePartReader(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.name = path.string();
    OIIO::ImageSpec first;
    s.input = openExr(path, first, headBytes);
    const auto margin = static_cast<std::int64_t>(first.full_x) - first.x;
    if (first.full_width < 1 || first.full_height < 1 || margin < 0 || first.full_width + 2 * margin != first.width ||
        first.full_height + 2 * margin != first.height)
        fail("cannot read {}: its data window must be its display window extended by the same margin on all sides",
             s.name);
    if (pixelCount(first.width, first.height) > maxPixels)
        fail("cannot read {}: {}x{} pixels exceed the maximum of {} million", s.name, first.width, first.height,
             maxPixels / 1000000);
    s.size = {first.full_width, first.full_height, static_cast<int>(margin)};
    for (int part = 0; part == 0 || s.input->seek_subimage(part, 0); ++part) {
        const OIIO::ImageSpec& own = s.input->spec();
        if (own.channelnames != channelNames || own.deep || own.tile_width > 0)
            fail(
                "{}: image {} must be untiled and have the channels R, G, B, A and Z; give a file from 'defocus render "
                "--lens-images'",
                s.name, part);
        if (own.x != -s.size.margin || own.y != own.x || own.width != s.size.fullWidth() ||
            own.height != s.size.fullHeight())
            fail("cannot read {}: image {} and image 0 differ in size", s.name, part);
        if (s.metadata.size() == maxImageParts)
            fail("cannot read {}: it has more than {} images", s.name, maxImageParts);
        s.metadata.push_back(metadataOf(own));
    }
    static_cast<void>(s.input->geterror());  // clears the error from the attempt to open a part after the last one
}

ImagePartReader::~ImagePartReader() = default;
ImagePartReader::ImagePartReader(ImagePartReader&&) noexcept = default;

const PartSize& ImagePartReader::size() const {
    return state_->size;
}

std::size_t ImagePartReader::count() const {
    return state_->metadata.size();
}

const Metadata& ImagePartReader::metadata(std::size_t part) const {
    return state_->metadata[part];
}

HalfImage ImagePartReader::colour(std::size_t part) {
    const PartSize& size = state_->size;
    HalfImage image{size.fullWidth(), size.fullHeight(), {}};
    image.rgba.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
    state_->read(part, 0, 4, OIIO::TypeHalf, image.rgba.data());
    return image;
}

Image ImagePartReader::depth(std::size_t part) {
    Image image(state_->size.fullWidth(), state_->size.fullHeight(), 1);
    state_->read(part, depthChannel, 1, OIIO::TypeFloat, image.pixels.data());
    return image;
}

}  // namespace defocus::engine
