#include "image/png_structure.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr std::size_t signatureLength = 8;
constexpr std::size_t chunkOverhead = 12;  // bytes of a chunk's length, type and checksum
constexpr std::array<std::string_view, 8> keptChunks = {"IHDR", "PLTE", "IDAT", "IEND", "tRNS", "gAMA", "sRGB", "tEXt"};

constexpr std::array<std::uint32_t, 256> makeChecksumTable() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xedb88320u : 0u);
        table[byte] = remainder;
    }
    return table;
}
constexpr std::array<std::uint32_t, 256> checksumTable = makeChecksumTable();

// Returns the CRC-32 of ISO 3309, section 5.5.
std::uint32_t checksum(std::span<const std::byte> bytes) {
    std::uint32_t value = 0xffffffffu;
    for (const std::byte byte : bytes) value = checksumTable[(value ^ std::uint32_t(byte)) & 0xff] ^ (value >> 8);
    return ~value;
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

}  // namespace

std::vector<unsigned char> checkedPng(std::span<const std::byte> encoded, const std::string& name) {
    std::vector<unsigned char> kept;
    kept.reserve(encoded.size());
    append(kept, encoded.first(std::min(signatureLength, encoded.size())));
    bool hasPixels = false;
    for (std::size_t offset = kept.size(); encoded.size() - offset >= chunkOverhead;) {
        const std::span<const std::byte> rest = encoded.subspan(offset);
        const std::size_t length = bigEndian(rest);
        const std::string_view type(reinterpret_cast<const char*>(rest.data()) + 4, 4);
        if (length > rest.size() - chunkOverhead) break;
        if (checksum(rest.subspan(4, 4 + length)) != bigEndian(rest.subspan(8 + length)))
            fail("{}: damaged PNG image: wrong checksum at byte {}", name, offset);
        if (offset == signatureLength && type != "IHDR") fail("{}: damaged PNG image: no header", name);
        hasPixels = hasPixels || type == "IDAT";
        const std::size_t chunkSize = chunkOverhead + length;
        if (std::ranges::find(keptChunks, type) != keptChunks.end()) append(kept, rest.first(chunkSize));
        if (type == "IEND") {
            if (!hasPixels) fail("{}: damaged PNG image: no pixels", name);
            return kept;
        }
        offset += chunkSize;
    }
    fail("{}: truncated PNG image", name);
}

}  // namespace defocus::engine
