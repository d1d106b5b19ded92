#pragma once
// Builds PNG files of any colour type byte by byte, with stored deflate blocks, so that tests can read files that no
// library has written.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace defocus::engine {

using Bytes = std::vector<std::uint8_t>;

enum class PngColour : std::uint8_t { grey = 0, rgb = 2, palette = 3, greyAlpha = 4, rgba = 6 };

inline void appendBigEndian(Bytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

inline void appendChunk(Bytes& png, const std::string& type, const Bytes& data) {
    Bytes checked(type.begin(), type.end());
    checked.insert(checked.end(), data.begin(), data.end());
    std::uint32_t crc = 0xffffffffu;
    for (const std::uint8_t byte : checked) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xedb88320u : crc >> 1;
    }
    appendBigEndian(png, static_cast<std::uint32_t>(data.size()));
    png.insert(png.end(), checked.begin(), checked.end());
    appendBigEndian(png, ~crc);
}

// Returns the zlib stream with one stored block. `rows` must have fewer than 65,536 bytes.
inline Bytes storedZlib(const Bytes& rows) {
    Bytes zlib = {0x78, 0x01, 0x01};  // header, then one final stored block
    const auto length = static_cast<std::uint16_t>(rows.size());
    for (const std::uint16_t value : {length, static_cast<std::uint16_t>(~length)}) {
        zlib.push_back(static_cast<std::uint8_t>(value & 0xff));
        zlib.push_back(static_cast<std::uint8_t>(value >> 8));
    }
    zlib.insert(zlib.end(), rows.begin(), rows.end());
    std::uint32_t a = 1, b = 0;  // the two sums of the Adler-32 checksum
    for (const std::uint8_t byte : rows) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    appendBigEndian(zlib, (b << 16) | a);
    return zlib;
}

// Returns a PNG file. `samples`: the bytes of the rows without filter bytes; 16-bit samples are big-endian. Rows and
// filter bytes together must have fewer than 65,536 bytes.
inline Bytes buildPng(int width, int height, int bits, PngColour colour, const Bytes& samples,
                      const Bytes& palette = {}) {
    Bytes rows;
    const std::size_t rowLength = samples.size() / static_cast<std::size_t>(height);
    for (int y = 0; y < height; ++y) {
        rows.push_back(0);  // filter type 0: none
        const auto first = samples.begin() + static_cast<std::ptrdiff_t>(rowLength) * y;
        rows.insert(rows.end(), first, first + static_cast<std::ptrdiff_t>(rowLength));
    }
    Bytes header;
    appendBigEndian(header, static_cast<std::uint32_t>(width));
    appendBigEndian(header, static_cast<std::uint32_t>(height));
    for (const int value : {bits, static_cast<int>(colour), 0, 0, 0})
        header.push_back(static_cast<std::uint8_t>(value));

    Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    appendChunk(png, "IHDR", header);
    if (!palette.empty()) appendChunk(png, "PLTE", palette);
    appendChunk(png, "IDAT", storedZlib(rows));
    appendChunk(png, "IEND", {});
    return png;
}

}  // namespace defocus::engine
