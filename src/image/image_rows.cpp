#include "image/image_rows.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "image/exr_structure.h"
#include "image/image_encoding.h"
#include "image/image_read.h"
#include "image/oiio_names.h"
#include "image/packed_pixels.h"

namespace defocus::engine {

namespace {

constexpr int rowsAtOnce = 64;  // max rows encoded per call; a multiple of EXR's 16-row blocks

}  // namespace

// Writes a file and stores the latest write error, because image libraries do not check each write.
class CheckedFile final : public OIIO::Filesystem::IOProxy {
public:
    explicit CheckedFile(const std::filesystem::path& path)
        : IOProxy(path.string(), Write), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
        if (descriptor_ < 0) failure_ = errno;
    }
    ~CheckedFile() override { close(); }
    CheckedFile(const CheckedFile&) = delete;
    CheckedFile& operator=(const CheckedFile&) = delete;

    [[nodiscard]] const char* proxytype() const override { return "checked"; }
    void close() override {
        if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) failure_ = errno;
    }
    size_t write(const void* bytes, size_t count) override {
        const size_t written = pwrite(bytes, count, m_pos);
        m_pos += static_cast<int64_t>(written);
        size_ = std::max(size_, static_cast<size_t>(m_pos));
        return written;
    }
    size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
        size_t done = 0;
        while (done < count) {
            const ssize_t now = ::pwrite(descriptor_, static_cast<const char*>(bytes) + done, count - done,
                                         offset + static_cast<int64_t>(done));
            if (now < 0 && errno == EINTR) continue;
            if (now <= 0) {
                failure_ = now == 0 ? ENOSPC : errno;
                break;
            }
            done += static_cast<size_t>(now);
        }
        return done;
    }
    [[nodiscard]] size_t size() const override { return size_; }
    // Returns errno of the latest failed write; 0 if no write failed.
    [[nodiscard]] int failure() const { return failure_; }

private:
    int descriptor_ = -1;
    int failure_ = 0;
    size_t size_ = 0;
};

// ---- writing --------------------------------------------------------------------------------------------------------

struct ImageRowWriter::State {
    State(const std::filesystem::path& path, const WriteOptions& write, NamedBy namer)
        : name(path.string()),
          kind(fileKind(path)),
          options(write),
          pending(path, namer),
          file(pending.temporaryPath()) {}

    [[noreturn]] void failed() {
        const std::string reason = file.failure() != 0 ? std::strerror(file.failure()) : firstLine(output->geterror());
        fail("cannot write {}: {}", name, reason);
    }

    // Starts the file. Called only when the first rows are available: libpng prints a message if a file ends without
    // rows.
    void open() {
        output = OIIO::ImageOutput::create(formatName(kind), &file);
        if (!output) fail("cannot write {}: {}", name, firstLine(OIIO::geterror()));
        output->set_ioproxy(&file);
        if (!output->open("image", spec) || file.failure() != 0) failed();
    }

    std::string name;
    FileKind kind;
    WriteOptions options;
    PendingFile pending;
    CheckedFile file;
    std::unique_ptr<OIIO::ImageOutput> output;
    OIIO::ImageSpec spec;
    int channels = 0;  // channels of the rows passed to write()
    int written = 0;   // rows written so far
};

ImageRowWriter::ImageRowWriter(const std::filesystem::path& path, int width, int height, int channels,
                               const Metadata& metadata, const WriteOptions& options, const RowPlace& place,
                               NamedBy namer)
    : state_(std::make_unique<State>(path, options, namer)) {
    State& s = *state_;
    s.channels = channels;
    s.spec = imageSpec(s.kind, width, height, channels, metadata);
    if (place.imageHeight > 0) {
        assert(s.kind == FileKind::exr && place.firstRow + height <= place.imageHeight);
        s.spec.y = place.firstRow;
        s.spec.full_height = place.imageHeight;
        s.spec.full_y = 0;
    }
    if (s.file.failure() != 0) fail("cannot write {}: {}", s.name, std::strerror(s.file.failure()));
}

ImageRowWriter::~ImageRowWriter() = default;
ImageRowWriter::ImageRowWriter(ImageRowWriter&&) noexcept = default;

void ImageRowWriter::write(const ImageView& rows) {
    State& s = *state_;
    assert(rows.width == s.spec.width && rows.channels == s.channels && s.written + rows.height <= s.spec.height);
    if (!s.output) s.open();
    for (int first = 0; first < rows.height; first += rowsAtOnce) {
        const int count = std::min(rowsAtOnce, rows.height - first);
        const ImageView some = rowsOf(rows, first, count);
        std::vector<std::uint8_t> bytes;
        if (s.kind != FileKind::exr) bytes = displayBytes(s.kind, some, s.options, s.written);
        const void* pixels = s.kind == FileKind::exr ? static_cast<const void*>(some.pixels.data()) : bytes.data();
        const int begin = s.spec.y + s.written;
        if (!s.output->write_scanlines(begin, begin + count, 0, s.spec.format, pixels) || s.file.failure() != 0)
            s.failed();
        s.written += count;
    }
}

void ImageRowWriter::finish() {
    State& s = *state_;
    assert(s.written == s.spec.height);
    if (!s.output->close()) s.failed();
    s.output.reset();
    s.file.close();
    if (s.file.failure() != 0) s.failed();
    s.pending.commit();
}

// ---- reading --------------------------------------------------------------------------------------------------------

struct ImageRowReader::State {
    std::string name;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
};

ImageRowReader::ImageRowReader(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.name = path.string();
    s.input = openExr(path, s.spec);
    const std::vector<std::string> names(s.spec.channelnames.begin(), s.spec.channelnames.end());
    const bool colours =
        names == std::vector<std::string>{"R", "G", "B"} || names == std::vector<std::string>{"R", "G", "B", "A"};
    if (!colours || s.spec.width < 1 || s.spec.height < 1 || s.spec.deep || s.spec.tile_width > 0)
        fail("{}: not a scan-line EXR file with the channels R, G, B or R, G, B, A", s.name);
}

ImageRowReader::~ImageRowReader() = default;
ImageRowReader::ImageRowReader(ImageRowReader&&) noexcept = default;

int ImageRowReader::width() const {
    return state_->spec.width;
}

int ImageRowReader::height() const {
    return state_->spec.height;
}

int ImageRowReader::channels() const {
    return state_->spec.nchannels;
}

RowPlace ImageRowReader::place() const {
    const OIIO::ImageSpec& spec = state_->spec;
    return {spec.y - spec.full_y, spec.full_height};
}

Metadata ImageRowReader::metadata() const {
    return metadataOf(state_->spec);
}

Image ImageRowReader::read(int first, int count) {
    State& s = *state_;
    assert(first >= 0 && count >= 1 && first + count <= s.spec.height);
    Image rows(s.spec.width, count, s.spec.nchannels);
    const int begin = s.spec.y + first;
    if (!s.input->read_scanlines(0, 0, begin, begin + count, 0, 0, s.spec.nchannels, OIIO::TypeFloat,
                                 rows.pixels.data()))
        fail("cannot read {}: {}", s.name, firstLine(s.input->geterror()));
    return rows;
}

}  // namespace defocus::engine
