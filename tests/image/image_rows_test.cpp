// Tests that files written row by row equal files written in one call, and that files with some of a frame's rows have
// these rows at the right position.

#include "image/image_rows.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

Image pattern(int width, int height) {
    Image image(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float* pixel = image.at(x, y);
            const float alpha = static_cast<float>((x + y) % 5) / 4;
            for (int c = 0; c < 3; ++c) pixel[c] = alpha * static_cast<float>((x * 7 + y * 13 + c * 31) % 97) / 60;
            pixel[3] = alpha;
        }
    return image;
}

Image rowsOf(const Image& image, int first, int count) {
    Image rows(image.width, count, image.channels);
    std::copy_n(image.at(0, first), rows.pixels.size(), rows.pixels.begin());
    return rows;
}

class ImageRows : public testing::Test {
protected:
    [[nodiscard]] const fs::path& folder() const { return folder_.path(); }

private:
    ScratchFolder folder_;
};

TEST_F(ImageRows, giveThePixelsOfAWholeFile) {
    const Image image = pattern(53, 201);
    const Metadata metadata = {{"comments", std::string("said")}, {"defocus:samples", 3}};
    WriteOptions options;
    options.exposure = 0.3;
    options.toneMap = ToneMap::agx;
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        writeImage(folder() / name, image, metadata, options);
        const fs::path other = folder() / (std::string("rows-") + name);
        ImageRowWriter writer(other, 53, 201, 4, metadata, options);
        for (int first = 0; first < 201; first += 90) writer.write(rowsOf(image, first, std::min(90, 201 - first)));
        EXPECT_FALSE(fs::exists(other)) << "an incomplete file must not have its final name";
        writer.finish();
        Metadata known, written;
        EXPECT_TRUE(readImage(other, written).pixels == readImage(folder() / name, known).pixels) << name;
        EXPECT_EQ(written.at("comments"), known.at("comments"));
    }
}

TEST_F(ImageRows, ofAPartLieInTheirPlace) {
    const Image image = pattern(53, 201);
    ImageRowWriter writer(folder() / "part.exr", 53, 70, 4, {{"defocus:samples", 3}}, {}, {100, 201});
    writer.write(rowsOf(image, 100, 70));
    writer.finish();
    ImageRowReader reader(folder() / "part.exr");
    EXPECT_EQ(reader.place().firstRow, 100);
    EXPECT_EQ(reader.place().imageHeight, 201);
    EXPECT_EQ(reader.width(), 53);
    EXPECT_EQ(reader.height(), 70);
    EXPECT_EQ(std::get<int>(reader.metadata().at("defocus:samples")), 3);
    EXPECT_TRUE(reader.read(0, 30).pixels == rowsOf(image, 100, 30).pixels);
    EXPECT_TRUE(reader.read(30, 40).pixels == rowsOf(image, 130, 40).pixels);
}

TEST_F(ImageRows, unfinishedFilesAreRemoved) {
    { ImageRowWriter(folder() / "a.exr", 53, 201, 4, {}).write(pattern(53, 100)); }
    EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(ImageRows, thatNeverCameAreGivenUpWithoutAWord) {
    testing::internal::CaptureStderr();
    for (const std::string name : {"a.exr", "a.png", "a.jpg"}) ImageRowWriter writer(folder() / name, 4, 3, 4, {});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(ImageRows, whatIsNoFileOfRowsIsRefused) {
    writeImage(folder() / "a.png", pattern(8, 8));
    writeFile(folder() / "b.exr", "not an image");
    for (const char* name : {"a.png", "b.exr", "missing.exr", "."}) {
        const std::string said = messageOf<Error>([&] { ImageRowReader reader(folder() / name); });
        const std::string path = (folder() / name).string();
        EXPECT_TRUE(said.starts_with(path) || said.starts_with("cannot read " + path + ": ")) << said;
    }
}

// Writing to a full disk, simulated by a limit on the file size, throws an Error with the file's name.
TEST_F(ImageRows, aFullDiskIsAnErrorThatNamesTheFile) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{20'000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    for (const std::string name : {"a.exr", "a.png", "a.jpg"}) {
        const std::string said = messageOf<Error>([&] {
            ImageRowWriter writer(folder() / name, 530, 201, 4, {});
            writer.write(pattern(530, 201));
            writer.finish();
        });
        EXPECT_NE(said.find("cannot write " + (folder() / name).string() + ": File too large"), std::string::npos)
            << said;
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(fs::is_empty(folder()));
}

// Attributes with invalid sizes are rejected. OpenEXR itself would allocate as much memory as the size says.
TEST_F(ImageRows, sizesThatAreNoAttributesAreRefused) {
    const fs::path path = folder() / "image.exr";
    writeImage(path, pattern(4, 3), {{"owner", std::string("nobody")}});
    const std::vector<std::byte> full = readFile(path);
    // Overwrites the size field of an attribute with `number`; with `offset`, overwrites the 32-bit number `offset`
    // bytes after the start of this field.
    const auto withNumber = [&](const std::string& attribute, const std::string& type, std::uint32_t number,
                                std::size_t offset = 0) {
        std::string bytes(reinterpret_cast<const char*>(full.data()), full.size());
        const std::string begin = attribute + '\0' + type + '\0';
        const std::size_t at = bytes.find(begin) + begin.size() + offset;
        for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(number >> (8 * i));
        writeFile(path, bytes);
    };
    const auto expectRefused = [&](const std::string& reason) {
        for (const auto& read : {std::function<void()>([&] { static_cast<void>(readImage(path)); }),
                                 std::function<void()>([&] { ImageRowReader reader(path); })}) {
            try {
                read();
                ADD_FAILURE() << reason;
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
            }
        }
    };
    withNumber("owner", "string", 6);  // the attribute's true size
    EXPECT_NO_THROW(static_cast<void>(readImage(path)));
    withNumber("owner", "string", 2'000'000'000);
    expectRefused("'owner'");
    withNumber("dataWindow", "box2i", 12);
    expectRefused("'dataWindow'");
    // Last column of the data window; it follows the size (4 bytes) and the window's first column and row (8 bytes).
    withNumber("dataWindow", "box2i", 9'999'999, 4 + 8);
    expectRefused("its rows have 10000000 pixels");
    withNumber("channels", "chlist", 54);
    expectRefused("'channels'");
}

}  // namespace
}  // namespace defocus::engine
