// EXR files ("OpenEXR File Layout") start with eight bytes, then headers. A header is a list of attributes that ends
// with an empty name. An attribute is a zero-terminated name, a zero-terminated type, a 32-bit little-endian byte
// count, and the value.

#include "image/exr_structure.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

namespace defocus::engine {

namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t headersBegin = 8;
constexpr std::size_t channelBytes = 16;     // bytes after each channel's name in a channel list
constexpr std::int64_t widestRow = 1 << 20;  // max width in px; limits memory: OpenEXR allocates several rows at once

// Attribute types with a fixed size in bytes.
constexpr std::array<std::pair<std::string_view, std::uint64_t>, 23> sizes = {{
    {"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
    {"m44d", 128},      {"m44f", 64},    {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
    {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
    {"v3f", 12},        {"v3i", 12},
}};

// Returns the zero-terminated text at offset `at`; nullopt if `bytes` ends before the zero.
std::optional<std::string_view> textAt(Bytes bytes, std::size_t at) {
    const Bytes rest = bytes.subspan(std::min(at, bytes.size()));
    const auto zero = std::ranges::find(rest, std::byte{0});
    if (zero == rest.end()) return {};
    return std::string_view(reinterpret_cast<const char*>(rest.data()), static_cast<std::size_t>(zero - rest.begin()));
}

std::uint32_t number(Bytes bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

// Returns the width in px of a box2i attribute (xMin, yMin, xMax, yMax), whose bounds are inclusive.
std::int64_t widthOf(Bytes box) {
    const auto column = [&](std::size_t at) { return std::int64_t{static_cast<std::int32_t>(number(box, at))}; };
    return column(8) - column(0) + 1;
}

// Returns whether an attribute's value is a valid channel list, which ends with an empty name.
bool isChannelList(Bytes value) {
    for (std::size_t at = 0; at < value.size();) {
        const auto channel = textAt(value, at);
        if (!channel) return false;
        if (channel->empty()) return at + 1 == value.size();
        at += channel->size() + 1 + channelBytes;
    }
    return false;
}

// Returns a name from a damaged file for a message: characters outside printable ASCII become '?'.
std::string shown(std::string_view name) {
    std::string text(name);
    std::ranges::replace_if(
        text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return text;
}

}  // namespace

void checkExrHeader(Bytes head, std::uint64_t fileBytes, const std::string& name) {
    // Bit 4 of byte 5 marks multi-part files, which have one header per part, then an empty header.
    const bool parts = head.size() > 5 && (head[5] & std::byte{0x10}) != std::byte{0};
    const int last = parts ? 2 : 1;
    int empty = 0;  // number of consecutive empty names: one ends a header, two end all headers
    for (std::size_t at = headersBegin; at < head.size() && empty < last;) {
        const auto attribute = textAt(head, at);
        if (!attribute) return;
        at += attribute->size() + 1;
        empty = attribute->empty() ? empty + 1 : 0;
        if (attribute->empty()) continue;
        const auto type = textAt(head, at);
        if (!type || at + type->size() + 1 + 4 > head.size()) return;
        at += type->size() + 1;
        const std::uint64_t bytes = number(head, at);
        at += 4;
        const auto refuse = [&] {
            fail("cannot read {}: its attribute '{}' has the invalid size of {} bytes", name, shown(*attribute), bytes);
        };
        if (bytes > fileBytes - std::min<std::uint64_t>(fileBytes, at)) refuse();
        const auto known = std::ranges::find(sizes, *type, &std::pair<std::string_view, std::uint64_t>::first);
        if (known != sizes.end() && known->second != bytes) refuse();
        if (bytes > head.size() - at) return;
        if (*attribute == "dataWindow" && *type == "box2i" && widthOf(head.subspan(at, bytes)) > widestRow)
            fail("cannot read {}: its rows have {} pixels; the maximum is {}", name, widthOf(head.subspan(at, bytes)),
                 widestRow);
        if (*type == "chlist" && !isChannelList(head.subspan(at, bytes))) refuse();
        at += bytes;
    }
}

void checkExrHeader(const std::filesystem::path& path, std::size_t headBytes) {
    std::vector<std::byte> head(headBytes);
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    checkExrHeader(head, std::filesystem::file_size(path), path.string());
}

}  // namespace defocus::engine
