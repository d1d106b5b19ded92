// Tests that damaged PNG files are rejected before libpng reads them, since libpng would print its own line to stderr.

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/image_read.h"
#include "png_builder.h"

namespace defocus::engine {
namespace {

const Bytes signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t headerEnd = 33;  // bytes of signature and IHDR

Bytes headerFields(int width, int height, std::initializer_list<int> others) {
    Bytes fields;
    appendBigEndian(fields, static_cast<std::uint32_t>(width));
    appendBigEndian(fields, static_cast<std::uint32_t>(height));
    for (const int value : others) fields.push_back(static_cast<std::uint8_t>(value));
    return fields;
}

// Returns a grey image of 4 × 4 px whose IHDR and IDAT have these contents.
Bytes pngOf(const Bytes& header, const std::vector<Bytes>& pixels, const Bytes& palette = {}) {
    Bytes png = signature;
    appendChunk(png, "IHDR", header);
    if (!palette.empty()) appendChunk(png, "PLTE", palette);
    for (const Bytes& data : pixels) {
        appendChunk(png, "IDAT", data);
        if (pixels.size() > 1) appendChunk(png, "tEXt", {'a', 0, 'b'});
    }
    appendChunk(png, "IEND", {});
    return png;
}

// Returns rows of these lengths, each after its filter byte.
Bytes rowsOf(std::initializer_list<std::size_t> lengths, std::uint8_t filter = 0) {
    Bytes rows;
    for (const std::size_t length : lengths) {
        rows.push_back(filter);
        rows.insert(rows.end(), length, 100);
    }
    return rows;
}

// Returns the image data of a PNG of 4 × 4 px whose rows have `length` bytes and the filter type `filter`.
Bytes streamOf(std::size_t length, std::uint8_t filter) {
    return storedZlib(rowsOf({length, length, length, length}, filter));
}

std::string faultOf(const Bytes& png) {
    testing::internal::CaptureStderr();
    std::string fault;
    try {
        static_cast<void>(decodeTexture(std::as_bytes(std::span(png)), "photo.png"));
    } catch (const Error& error) {
        fault = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << fault;
    return fault;
}

const Bytes grey = headerFields(4, 4, {8, 0, 0, 0, 0});

TEST(DamagedPng, intactFilesAreRead) {
    EXPECT_EQ(faultOf(pngOf(grey, {streamOf(4, 0)})), "");
    EXPECT_EQ(faultOf(pngOf(headerFields(4, 4, {8, 3, 0, 0, 0}), {streamOf(4, 0)}, Bytes(303, 7))), "");
}

// An interlaced image of 4 × 4 px has one row in passes 1, 4 and 5, and two rows in passes 6 and 7.
TEST(DamagedPng, interlacedFilesAreRead) {
    const Bytes header = headerFields(4, 4, {8, 0, 0, 0, 1});
    EXPECT_EQ(faultOf(pngOf(header, {storedZlib(rowsOf({1, 1, 2, 2, 2, 4, 4}))})), "");
    EXPECT_NE(faultOf(pngOf(header, {storedZlib(rowsOf({1, 1, 2, 2, 2, 4, 3}))})).find("too few pixels"),
              std::string::npos);
}

TEST(DamagedPng, headersAndPalettesAreChecked) {
    for (const auto& fields : {headerFields(4, 4, {3, 0, 0, 0, 0}), headerFields(4, 4, {8, 5, 0, 0, 0}),
                               headerFields(4, 4, {16, 3, 0, 0, 0}), headerFields(4, 4, {8, 0, 1, 0, 0}),
                               headerFields(4, 4, {8, 0, 0, 0, 9}), headerFields(0, 4, {8, 0, 0, 0, 0}),
                               headerFields(1'000'001, 1, {8, 0, 0, 0, 0}), headerFields(4, 4, {8, 0, 0, 0})})
        EXPECT_TRUE(faultOf(pngOf(fields, {streamOf(4, 0)})).starts_with("photo.png: damaged PNG image: "));
    const Bytes palette = headerFields(4, 4, {8, 3, 0, 0, 0});
    for (const std::size_t length : {0, 7, 771})
        EXPECT_NE(faultOf(pngOf(palette, {streamOf(4, 0)}, Bytes(length))).find("palette"), std::string::npos);
    Bytes twice = pngOf(grey, {streamOf(4, 0)});
    twice.insert(twice.begin() + headerEnd, twice.begin() + 8, twice.begin() + headerEnd);
    EXPECT_NE(faultOf(twice).find("two headers"), std::string::npos);
}

TEST(DamagedPng, pixelsAreChecked) {
    const Bytes stream = streamOf(4, 0);
    const Bytes begin(stream.begin(), stream.begin() + 12), end(stream.begin() + 12, stream.end());
    EXPECT_NE(faultOf(pngOf(grey, {Bytes(30, 0xff)})).find("invalid compressed pixels"), std::string::npos);
    EXPECT_NE(faultOf(pngOf(grey, {begin})).find("too few pixels"), std::string::npos);
    EXPECT_NE(faultOf(pngOf(grey, {storedZlib(rowsOf({4, 4, 4}))})).find("too few pixels"), std::string::npos);
    EXPECT_NE(faultOf(pngOf(grey, {streamOf(4, 9)})).find("filter"), std::string::npos);
    EXPECT_NE(faultOf(pngOf(grey, {begin, end})).find("interrupts the image data"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
