#include "image/image_io.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>

#include "core/error.h"
#include "core/file.h"
#include "models.h"
#include "png_builder.h"
#include "scratch_folder.h"
#include "special_values.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

Image gradient(int width, int height, int channels) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 97) / 96.0f;
    return image;
}

std::string readText(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void writeBytes(const fs::path& path, const Bytes& bytes) {
    writeFile(path, std::as_bytes(std::span(bytes)));
}

std::string readFault(const fs::path& path) {
    return messageOf<Error>([&] { readImage(path); });
}

// Expects a message of one line that begins with the file name or with "cannot read NAME: ".
void expectReadFault(const std::string& message, const std::string& name) {
    EXPECT_TRUE(message.starts_with(name) || message.starts_with("cannot read " + name + ": ")) << message;
    EXPECT_GT(message.size(), name.size() + 2) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(ImageFile, exrKeepsEveryFloat) {
    const ScratchFolder folder;
    for (const int channels : {1, 3, 4}) {
        Image image = gradient(13, 7, channels);
        image.pixels[0] = 6.5e4f * 1000;
        image.pixels[1] = -3.25f;
        image.pixels[2] = infinity;
        image.pixels[3] = notANumber;
        image.pixels[4] = 1e-30f;
        writeImage(folder / "a.exr", image);
        const Image read = readImage(folder / "a.exr");
        ASSERT_EQ(read.width, 13);
        ASSERT_EQ(read.height, 7);
        ASSERT_EQ(read.channels, channels);
        ASSERT_EQ(read.pixels.size(), image.pixels.size());
        EXPECT_EQ(std::memcmp(read.pixels.data(), image.pixels.data(), image.pixels.size() * sizeof(float)), 0);
    }
}

TEST(ImageFile, exrKeepsMetadataUnderStandardNames) {
    const ScratchFolder folder;
    glm::mat4 matrix(1.0f);
    matrix[3] = {5, 6, 7, 1};
    const Metadata metadata = {{"aperture", 1.4},
                               {"focus", 2.5},
                               {"nominalFocalLength", 50.0},
                               {"expTime", 0.02},
                               {"comments", "a fish"},
                               {"worldToCamera", matrix},
                               {"defocus:samples", 64},
                               {"defocus:seconds", 0.1234567890123},
                               {"defocus:version", "0.1"}};
    writeImage(folder / "a.exr", gradient(4, 4, 3), metadata);
    Metadata read;
    readImage(folder / "a.exr", read);
    for (const auto& [name, value] : metadata) {
        ASSERT_TRUE(read.contains(name)) << name;
        EXPECT_TRUE(read[name] == value) << name;
    }
    // The file has the attributes with the names and types of the OpenEXR standard.
    const std::string text = readText(folder / "a.exr");
    using namespace std::string_literals;
    for (const std::string& attribute :
         {"aperture\0float\0"s, "focus\0float\0"s, "expTime\0float\0"s, "nominalFocalLength\0float\0"s,
          "worldToCamera\0m44f\0"s, "comments\0string\0"s, "defocus:samples\0int\0"s})
        EXPECT_NE(text.find(attribute), std::string::npos) << attribute;
    // OpenEXR multiplies row vectors, so the translation is the last row of the file's matrix.
    const std::size_t start = text.find("worldToCamera\0m44f\0"s) + 19 + 4;
    float stored[16];
    ASSERT_LE(start + sizeof stored, text.size());
    std::memcpy(stored, text.data() + start, sizeof stored);
    EXPECT_EQ(stored[12], 5);
    EXPECT_EQ(stored[14], 7);
}

TEST(ImageFile, noFileTellsWhereItWasMade) {
    const ScratchFolder folder;
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        writeImage(folder / name, gradient(4, 4, 3), {{"defocus:samples", 1}});
        const std::string text = readText(folder / name);
        EXPECT_EQ(text.find(folder.path().string()), std::string::npos) << name;
        EXPECT_EQ(text.find("oftware"), std::string::npos) << name;
        EXPECT_EQ(text.find("OpenImageIO"), std::string::npos) << name;
    }
}

TEST(ImageFile, pngKeepsAll256Levels) {
    const ScratchFolder folder;
    Image image(256, 2, 3);
    for (int x = 0; x < 256; ++x)
        for (int y = 0; y < 2; ++y)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = srgbDecode(static_cast<float>(x) / 255.0f);
    writeImage(folder / "a.png", image);
    const Image read = readImage(folder / "a.png");
    ASSERT_EQ(read.channels, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_NEAR(read.pixels[i], image.pixels[i], 1e-6);
}

TEST(ImageFile, pngHoldsStraightAlpha) {
    const ScratchFolder folder;
    Image image(2, 1, 4);
    // The first pixel has coverage 0.2, with the colour 0.5 in the covered part. The second pixel has emission without
    // coverage, which PNG cannot represent.
    for (int c = 0; c < 4; ++c) image.at(0, 0)[c] = c == 3 ? 0.2f : 0.2f * 0.5f;
    image.at(1, 0)[0] = 0.7f;
    writeImage(folder / "a.png", image);
    const TextureImage raw = decodeTexture(readFile(folder / "a.png"), "a.png");
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(raw.rgba[c], 187.5, 0.51);  // 255 · sRGB(0.5) = 187.5, dithered
    EXPECT_EQ(Bytes(raw.rgba.begin() + 3, raw.rgba.end()), (Bytes{51, 0, 0, 0, 0}));
    const Image read = readImage(folder / "a.png");
    ASSERT_EQ(read.channels, 4);
    EXPECT_NEAR(read.at(0, 0)[0], 0.1f, 1e-3);
    EXPECT_NEAR(read.at(0, 0)[3], 0.2f, 1e-6);
}

TEST(ImageFile, pngHoldsMetadataAsText) {
    const ScratchFolder folder;
    writeImage(folder / "a.png", gradient(4, 4, 3),
               {{"aperture", 1.4}, {"defocus:samples", 64}, {"defocus:name", "x"}});
    Metadata read;
    readImage(folder / "a.png", read);
    EXPECT_TRUE(read["aperture"] == MetadataValue("1.4"));
    EXPECT_TRUE(read["defocus:samples"] == MetadataValue("64"));
    EXPECT_TRUE(read["defocus:name"] == MetadataValue("x"));
}

TEST(ImageFile, jpegShowsTheColourOverBlack) {
    const ScratchFolder folder;
    Image image(16, 16, 4);
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        image.pixels[i] = image.pixels[i + 1] = image.pixels[i + 2] = 0.25f;
        image.pixels[i + 3] = 0.5f;
    }
    for (const char* name : {"a.jpg", "a.JPEG"}) {
        writeImage(folder / name, image);
        const Image read = readImage(folder / name);
        ASSERT_EQ(read.channels, 3);
        for (const float value : read.pixels) ASSERT_NEAR(srgbEncode(value), srgbEncode(0.25f), 1.5 / 255);
    }
}

TEST(ImageFile, eightBitFilesAreExposedAndToneMapped) {
    const ScratchFolder folder;
    Image image(1, 1, 1);
    image.pixels[0] = 0.125f;
    writeImage(folder / "a.png", image, {}, {.toneMap = ToneMap::none, .exposure = 2});
    EXPECT_NEAR(srgbEncode(readImage(folder / "a.png").pixels[0]), srgbEncode(0.5f), 1.0 / 255);
    writeImage(folder / "b.png", image, {}, {.toneMap = ToneMap::aces, .exposure = 0});
    EXPECT_NEAR(srgbEncode(readImage(folder / "b.png").pixels[0]), displayEncoded(image, ToneMap::aces).pixels[0],
                1.0 / 255);
}

TEST(ImageFile, nonFiniteColoursBecomeBlackOrWhiteInEightBits) {
    const ScratchFolder folder;
    Image image(3, 1, 1);
    image.pixels = {notANumber, infinity, -infinity};
    writeImage(folder / "a.png", image);
    EXPECT_EQ(readImage(folder / "a.png").pixels, (std::vector<float>{0, 1, 0}));
}

TEST(ImageFile, unknownExtensionsAndOddImagesAreRefused) {
    const ScratchFolder folder;
    const std::string unknown = messageOf<Error>([] { checkImageExtension("out.webm"); });
    EXPECT_EQ(unknown, "out.webm: unknown image type \".webm\"; use .exr, .png, .jpg or .jpeg");
    EXPECT_THROW(checkImageExtension("out"), Error);
    EXPECT_NO_THROW(checkImageExtension("out.JPG"));
    EXPECT_THROW(writeImage(folder / "a.exr", Image{}), Error);
    EXPECT_THROW(writeImage(folder / "a.exr", Image(2, 2, 2)), Error);
    EXPECT_FALSE(fs::exists(folder / "a.exr"));
}

TEST(ImageFile, aMissingFolderIsNamed) {
    const ScratchFolder folder;
    const fs::path path = folder / "none/a.exr";
    const std::string message = messageOf<Error>([&] { writeImage(path, gradient(2, 2, 3)); });
    EXPECT_TRUE(message.starts_with("cannot write " + path.string() + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

// On a full disk, simulated by a file size limit of 1000 bytes, a write fails, keeps the old file and leaves no other
// file.
TEST(ImageFileDeathTest, aFullDiskLeavesTheOldFile) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto writeWithLittleSpace = [](const char* name) {
        const ScratchFolder folder;
        const fs::path path = folder / name;
        writeFile(path, "old");
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        Image noise(64, 64, 3);
        std::uint32_t state = 1;
        for (float& value : noise.pixels)
            value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
        const std::string message = messageOf<Error>([&] { writeImage(path, noise); });
        const bool alone = std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}) == 1;
        const bool good = message.starts_with("cannot write " + path.string()) && readText(path) == "old" && alone;
        fs::remove_all(folder.path());
        std::fprintf(stderr, "%s\n", message.c_str());
        std::_Exit(good ? 7 : 1);
    };
    EXPECT_EXIT(writeWithLittleSpace("a.exr"), testing::ExitedWithCode(7), "cannot write");
    EXPECT_EXIT(writeWithLittleSpace("a.png"), testing::ExitedWithCode(7), "cannot write");
    EXPECT_EXIT(writeWithLittleSpace("a.jpg"), testing::ExitedWithCode(7), "cannot write");
}

TEST(BadImageFile, missingDirectoryEmptyAndForeign) {
    const ScratchFolder folder;
    expectReadFault(readFault(folder / "none.png"), (folder / "none.png").string());
    EXPECT_NE(readFault(folder / "none.png").find("No such file"), std::string::npos);
    expectReadFault(readFault(folder.path()), folder.path().string());
    writeFile(folder / "empty.png", "");
    expectReadFault(readFault(folder / "empty.png"), (folder / "empty.png").string());
    writeFile(folder / "text.exr", "this is not an image, whatever its name says");
    expectReadFault(readFault(folder / "text.exr"), (folder / "text.exr").string());
}

TEST(BadImageFile, truncatedAtAnyLength) {
    const ScratchFolder folder;
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        writeImage(folder / name, gradient(40, 30, 3), {{"comments", "text"}});
        const std::vector<std::byte> full = readFile(folder / name);
        const fs::path cut = folder / (std::string("cut-") + name);
        for (std::size_t length = 0; length < full.size(); length += 1 + length / 37) {
            writeFile(cut, std::span(full).first(length));
            const std::string fault = readFault(cut);
            ASSERT_FALSE(fault.empty()) << name << " cut to " << length << " of " << full.size();
            expectReadFault(fault, cut.string());
        }
        writeFile(cut, std::span(full).first(full.size() - 1));
        EXPECT_FALSE(readFault(cut).empty()) << name;
    }
}

TEST(BadImageFile, aFlippedBitInAPngIsFound) {
    const Bytes png = buildPng(2, 2, 8, PngColour::grey, {1, 2, 3, 4});
    for (std::size_t i = 0; i < png.size(); ++i) {
        Bytes damaged = png;
        damaged[i] ^= 0x10;
        const std::string fault =
            messageOf<Error>([&] { decodeTexture(std::as_bytes(std::span(damaged)), "damaged"); });
        ASSERT_FALSE(fault.empty()) << "byte " << i;
        expectReadFault(fault, "damaged");
    }
}

// Damaged EXR and JPEG files never crash the reader. Damage to bytes without a checksum may change the image.
TEST(BadImageFile, damagedExrAndJpegNeverCrash) {
    const ScratchFolder folder;
    for (const char* name : {"a.exr", "a.jpg"}) {
        writeImage(folder / name, gradient(16, 16, 3));
        const std::vector<std::byte> full = readFile(folder / name);
        for (std::size_t i = 0; i < full.size(); i += 5) {
            std::vector<std::byte> damaged = full;
            damaged[i] ^= std::byte{0xa5};
            writeFile(folder / "damaged", damaged);
            const std::string fault = readFault(folder / "damaged");
            if (!fault.empty()) expectReadFault(fault, (folder / "damaged").string());
        }
    }
}

TEST(BadImageFile, aHeaderThatPromisesTooMuchIsRefused) {
    const ScratchFolder folder;
    writeBytes(folder / "huge.png", buildPng(1000000, 1000000, 8, PngColour::rgba, Bytes(16)));
    expectReadFault(readFault(folder / "huge.png"), (folder / "huge.png").string());
}

TEST(BadImageFile, contentDecidesNotTheName) {
    const ScratchFolder folder;
    writeBytes(folder / "really-a-png.jpg", buildPng(1, 1, 8, PngColour::rgb, {255, 0, 255}));
    EXPECT_EQ(readImage(folder / "really-a-png.jpg").pixels, (std::vector<float>{1, 0, 1}));
}

Bytes texture(const Bytes& png) {
    return decodeTexture(std::as_bytes(std::span(png)), "texture").rgba;
}

TEST(Texture, everyColourTypeBecomesStraightRgba) {
    EXPECT_EQ(texture(buildPng(2, 1, 8, PngColour::grey, {10, 200})), (Bytes{10, 10, 10, 255, 200, 200, 200, 255}));
    EXPECT_EQ(texture(buildPng(1, 1, 8, PngColour::greyAlpha, {100, 3})), (Bytes{100, 100, 100, 3}));
    EXPECT_EQ(texture(buildPng(1, 1, 8, PngColour::rgb, {1, 2, 3})), (Bytes{1, 2, 3, 255}));
    EXPECT_EQ(texture(buildPng(1, 2, 8, PngColour::rgba, {9, 99, 199, 0, 255, 128, 1, 2})),
              (Bytes{9, 99, 199, 0, 255, 128, 1, 2}));
    EXPECT_EQ(texture(buildPng(2, 1, 8, PngColour::palette, {1, 0}, {11, 12, 13, 21, 22, 23})),
              (Bytes{21, 22, 23, 255, 11, 12, 13, 255}));
    EXPECT_EQ(texture(buildPng(8, 1, 1, PngColour::grey, {0b10000001})).at(28), 255);
}

TEST(Texture, sixteenBitsAreRoundedToEight) {
    // 16-bit values are rounded to 8 bits: 255 · 0x80ff / 65535 = 128.5 → 128 or 129; 0xffff → 255; 0x0040 → 0.25 → 0
    const Bytes rgb = texture(buildPng(1, 1, 16, PngColour::rgb, {0x80, 0x80, 0xff, 0xff, 0x00, 0x40}));
    EXPECT_EQ(rgb, (Bytes{128, 255, 0, 255}));
    EXPECT_EQ(texture(buildPng(1, 1, 16, PngColour::greyAlpha, {0x40, 0x40, 0x10, 0x10})), (Bytes{64, 64, 64, 16}));
    EXPECT_EQ(texture(buildPng(1, 1, 16, PngColour::rgba, {255, 255, 0, 0, 255, 255, 0x20, 0x20})),
              (Bytes{255, 0, 255, 32}));
}

TEST(Texture, rowZeroIsTheTop) {
    const Bytes png = buildPng(1, 2, 8, PngColour::grey, {7, 70});
    EXPECT_EQ(texture(png), (Bytes{7, 7, 7, 255, 70, 70, 70, 255}));
}

TEST(Texture, otherFormatsAndGarbageAreRefused) {
    const ScratchFolder folder;
    writeImage(folder / "a.exr", gradient(2, 2, 3));
    EXPECT_EQ(messageOf<Error>([&] { decodeTexture(readFile(folder / "a.exr"), "image 3"); }),
              "image 3: not a PNG, JPEG or WebP image");
    EXPECT_THROW(decodeTexture({}, "nothing"), Error);
}

TEST(Texture, realTexturesDecode) {
    DEFOCUS_MODEL_OR_SKIP(path, "FlightHelmet/FlightHelmet_Materials_LensesMat_BaseColor.png");
    const std::vector<std::byte> file = readFile(path);
    const TextureImage texture = decodeTexture(file, path.string());
    const auto headerValue = [&](std::size_t offset) {  // reads an IHDR value at a file offset
        return int(file.at(offset)) << 24 | int(file.at(offset + 1)) << 16 | int(file.at(offset + 2)) << 8 |
               int(file.at(offset + 3));
    };
    EXPECT_EQ(texture.width, headerValue(16));
    EXPECT_EQ(texture.height, headerValue(20));
    EXPECT_EQ(texture.rgba.size(), std::size_t(texture.width) * std::size_t(texture.height) * 4);
}

// A file that begins like a JPEG but contains no image is rejected.
TEST(Texture, aJpegOfNothingIsRefused) {
    const ScratchFolder folder;
    const std::filesystem::path path = folder / "nothing.jpg";
    std::ofstream(path, std::ios::binary) << "\xFF\xD8\xFF\xE0 this is no picture";
    expectReadFault(messageOf<Error>([&] { decodeTexture(readFile(path), "image"); }), "image");
    expectReadFault(readFault(path), path.string());
}

TEST(Texture, anInvalidJpegIsRefused) {
    DEFOCUS_MODEL_OR_SKIP(path, "invalid/invalid_image_data.jpg");
    expectReadFault(messageOf<Error>([&] { decodeTexture(readFile(path), "image"); }), "image");
    expectReadFault(readFault(path), path.string());
}

// A JPEG with too little data for its size is rejected. Here the header declares 16,000 × 16,000 px, but the data
// belong to an image of 8 × 8 px. libjpeg would fill in the rest, which takes half a minute.
TEST(ImageFiles, aJpegTooShortForItsPixelsIsRefused) {
    const ScratchFolder folder;
    const fs::path path = folder / "a.jpg";
    writeImage(path, Image(8, 8, 3));
    std::vector<std::byte> bytes = readFile(path);
    // A SOF0 marker is followed by length (2 bytes), precision (1 byte), height and width.
    const std::array frame = {std::byte{0xff}, std::byte{0xc0}};
    const auto found = std::ranges::search(bytes, frame);
    ASSERT_FALSE(found.empty());
    for (const std::ptrdiff_t at : {5, 7}) {
        found.begin()[at] = std::byte{16'000 >> 8};
        found.begin()[at + 1] = std::byte{16'000 & 0xff};
    }
    writeFile(path, bytes);
    const std::string said = messageOf<Error>([&] { readImage(path); });
    EXPECT_NE(said.find("too few for 16000x16000 pixels"), std::string::npos) << said;
}

}  // namespace
}  // namespace defocus::engine
