#include "image/png_structure.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr std::size_t signatureLength = 8;
constexpr std::size_t chunkOverhead = 12;  // bytes of a chunk's length, type and checksum
constexpr std::array<std::string_view, 8> keptChunks = {"IHDR", "PLTE", "IDAT", "IEND", "tRNS", "gAMA", "sRGB", "tEXt"};

constexpr unsigned char filterTypes = 5;      // number of filter types of PNG rows (PNG specification, section 9.2)
constexpr std::uint32_t maxSide = 1'000'000;  // max width and height in px, libpng's limit
constexpr std::size_t headerLength = 13, maxPaletteLength = 3 * 256;

std::uint32_t checksum(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::uint32_t bigEndian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4)) value = (value << 8) | std::uint32_t(byte);
    return value;
}

void append(std::vector<unsigned char>& target, std::span<const std::byte> bytes) {
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    target.insert(target.end(), first, first + bytes.size());
}

// Content of a PNG file's IHDR chunk.
struct Header {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    unsigned bits = 0;    // bits per channel
    unsigned colour = 0;  // colour type
    bool interlaced = false;
};
constexpr unsigned paletteColour = 3;

unsigned channelsOf(unsigned colour) {
    return colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
}

Header headerOf(std::span<const std::byte> data, const std::string& name) {
    if (data.size() != headerLength)
        fail("{}: damaged PNG image: the header has {} bytes instead of 13", name, data.size());
    const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(data[i]); };
    const Header header{bigEndian(data), bigEndian(data.subspan(4)), byte(8), byte(9), byte(12) == 1};
    if (std::min(header.width, header.height) == 0 || std::max(header.width, header.height) > maxSide)
        fail("{}: damaged PNG image: its header has the invalid size {} x {} px", name, header.width, header.height);
    // Valid combinations of colour type and bits per channel: table 11.1 of the PNG specification.
    const unsigned bits = header.bits, colour = header.colour;
    const bool small = bits == 1 || bits == 2 || bits == 4;
    const bool valid =
        bits == 8 || (bits == 16 && colour != paletteColour) || (small && (colour == 0 || colour == paletteColour));
    if (!valid || colour > 6 || colour == 1 || colour == 5)
        fail("{}: damaged PNG image: colour type {} cannot have {} bits per channel", name, colour, bits);
    if (byte(10) != 0 || byte(11) != 0 || byte(12) > 1)
        fail("{}: damaged PNG image: unknown compression, filter or interlace method", name);
    return header;
}

// Returns the length in bytes of each row, in file order: one filter byte, then the pixels. Interlaced images consist
// of seven smaller images (PNG specification, section 8.2).
std::vector<std::size_t> rowLengths(const Header& header) {
    const auto bits = std::size_t{header.bits} * channelsOf(header.colour);
    std::vector<std::size_t> lengths;
    const auto add = [&](std::uint32_t firstX, std::uint32_t stepX, std::uint32_t firstY, std::uint32_t stepY) {
        if (header.width <= firstX || header.height <= firstY) return;
        const std::size_t width = (header.width - firstX + stepX - 1) / stepX;
        const std::size_t height = (header.height - firstY + stepY - 1) / stepY;
        lengths.insert(lengths.end(), height, 1 + (width * bits + 7) / 8);
    };
    if (!header.interlaced) {
        add(0, 1, 0, 1);
        return lengths;
    }
    constexpr std::uint32_t passes[7][4] = {{0, 8, 0, 8}, {4, 8, 0, 8}, {0, 4, 4, 8}, {2, 4, 0, 4},
                                            {0, 2, 2, 4}, {1, 2, 0, 2}, {0, 1, 1, 2}};
    for (const auto& pass : passes) add(pass[0], pass[1], pass[2], pass[3]);
    return lengths;
}

// Decompresses the bytes of the IDAT chunks, in order.
class PixelStream {
public:
    PixelStream(std::vector<std::span<const std::byte>> chunks, const std::string& name)
        : chunks_(std::move(chunks)), name_(name) {
        if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
    }
    ~PixelStream() { inflateEnd(&stream_); }
    PixelStream(const PixelStream&) = delete;
    PixelStream& operator=(const PixelStream&) = delete;

    // Decompresses bytes into `target`. Throws Error if the stream is damaged or ends early.
    void read(std::span<unsigned char> target) {
        stream_.next_out = target.data();
        stream_.avail_out = static_cast<uInt>(target.size());
        while (stream_.avail_out > 0) {
            if (stream_.avail_in == 0 && next_ < chunks_.size()) {
                const std::span<const std::byte> chunk = chunks_[next_++];
                // inflate() doesn't change its input, but takes a pointer to mutable bytes.
                stream_.next_in = reinterpret_cast<unsigned char*>(const_cast<std::byte*>(chunk.data()));
                stream_.avail_in = static_cast<uInt>(chunk.size());
                continue;
            }
            const int status = inflate(&stream_, Z_NO_FLUSH);
            if (status == Z_MEM_ERROR) throw std::bad_alloc();
            if (status == Z_OK || stream_.avail_out == 0) continue;
            fail("{}: damaged PNG image: {}", name_,
                 status == Z_DATA_ERROR ? "invalid compressed pixels" : "too few pixels for the size in its header");
        }
    }

private:
    std::vector<std::span<const std::byte>> chunks_;
    std::size_t next_ = 0;
    const std::string& name_;
    z_stream stream_{};
};

// A chunk of a PNG file whose structure is valid.
struct Chunk {
    std::string_view type;
    std::span<const std::byte> data;
};

Chunk chunkAt(std::span<const std::byte> rest) {
    return {{reinterpret_cast<const char*>(rest.data()) + 4, 4}, rest.subspan(8, bigEndian(rest))};
}

}  // namespace

std::vector<unsigned char> checkedPng(std::span<const std::byte> encoded, const std::string& name) {
    std::vector<unsigned char> chunks;
    chunks.reserve(encoded.size());
    append(chunks, encoded.first(std::min(signatureLength, encoded.size())));
    std::optional<Header> header;
    bool hasPalette = false, hasPixels = false, pixelsEnded = false;
    for (std::size_t offset = chunks.size(); encoded.size() - offset >= chunkOverhead;) {
        const std::span<const std::byte> rest = encoded.subspan(offset);
        const std::size_t length = bigEndian(rest);
        if (length > rest.size() - chunkOverhead) break;
        const auto [type, data] = chunkAt(rest);
        if (checksum(rest.subspan(4, 4 + length)) != bigEndian(rest.subspan(8 + length)))
            fail("{}: damaged PNG image: wrong checksum at byte {}", name, offset);
        if ((type == "IHDR") == header.has_value())
            fail("{}: damaged PNG image: {}", name, header ? "two headers" : "no header");
        if (!header) header = headerOf(data, name);
        const bool needsPalette = header->colour == paletteColour;
        if (type == "PLTE" && needsPalette) {
            if (data.empty() || data.size() % 3 != 0 || data.size() > maxPaletteLength || hasPalette)
                fail("{}: damaged PNG image: invalid palette", name);
            hasPalette = true;
        }
        if (type == "IDAT") {
            if (pixelsEnded) fail("{}: damaged PNG image: another chunk interrupts the image data", name);
            if (needsPalette && !hasPalette) fail("{}: damaged PNG image: no palette before the image data", name);
            hasPixels = true;
        } else {
            pixelsEnded = hasPixels;
        }
        const std::size_t chunkSize = chunkOverhead + length;
        const bool kept = std::ranges::find(keptChunks, type) != keptChunks.end() && (type != "PLTE" || needsPalette);
        if (kept) append(chunks, rest.first(chunkSize));
        if (type == "IEND") {
            if (!hasPixels) fail("{}: damaged PNG image: no image data", name);
            return chunks;
        }
        offset += chunkSize;
    }
    fail("{}: truncated PNG image", name);
}

void checkPngPixels(std::span<const unsigned char> checked, const std::string& name) {
    const std::span<const std::byte> bytes = std::as_bytes(checked);
    std::vector<std::span<const std::byte>> chunks;
    Header header;
    for (std::size_t offset = signatureLength; offset < bytes.size();) {
        const Chunk chunk = chunkAt(bytes.subspan(offset));
        if (chunk.type == "IHDR") header = headerOf(chunk.data, name);
        if (chunk.type == "IDAT") chunks.push_back(chunk.data);
        offset += chunkOverhead + chunk.data.size();
    }
    PixelStream stream(std::move(chunks), name);
    std::vector<unsigned char> row;
    for (const std::size_t length : rowLengths(header)) {
        row.resize(length);
        stream.read(row);
        if (row[0] >= filterTypes) fail("{}: damaged PNG image: a row has an unknown filter type", name);
    }
}

}  // namespace defocus::engine
