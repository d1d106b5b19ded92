// Tests the commands `render --lens-images` and `refocus`: their output files, and that each invalid use gives one
// error line and no file.

#include <fstream>
#include <iterator>

#include "cli/gl_program.h"
#include "cli/two_quads.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class RefocusCommand : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        if (!IsSkipped()) writeTwoQuads(folder() / "quads.gltf");
    }

    Outcome lensImages(const Words& more) const {
        Words words = {"render", "quads.gltf", "--size", "64x48", "--fstop", "1", "--focus-distance", "3", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }

    // Expects that a command line fails with a one-line error message that contains `text`, and that it writes no file.
    void expectRefused(const Words& line, const std::string& text, int exitCode = 1) const {
        const std::size_t files = fileCount();
        const Outcome outcome = run(line);
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
        EXPECT_EQ(fileCount(), files) << outcome.err;
    }

    [[nodiscard]] std::string textIn(const std::string& name) const {
        std::ifstream file(folder() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

TEST_F(RefocusCommand, writesPicturesStacksAndPages) {
    ASSERT_EQ(lensImages({"--samples", "16", "--focus-range", "2:5", "--lens-images", "a.lens.exr"}).exitCode, 0);
    // A reader that expects a single image reads only the image of the first lens point.
    EXPECT_EQ(readImage(folder() / "a.lens.exr").channels, 4);

    ASSERT_EQ(run({"refocus", "a.lens.exr", "-o", "a.exr", "-o", "a.png", "--focus-distance", "4"}).exitCode, 0);
    Metadata metadata;
    const Image picture = readImage(folder() / "a.exr", metadata);
    EXPECT_EQ(picture.width, 64);
    EXPECT_EQ(picture.height, 48);
    EXPECT_EQ(std::get<double>(metadata.at("defocus:focusDistance")), 4);
    EXPECT_FALSE(metadata.contains("defocus:lensImages"));

    ASSERT_EQ(run({"refocus", "a.lens.exr", "--stack", "3", "-o", "s.exr"}).exitCode, 0);
    for (const char* name : {"s.00.exr", "s.01.exr", "s.02.exr", "s.sharp.exr", "s.depth.exr"})
        EXPECT_TRUE(fs::exists(folder() / name)) << name;

    ASSERT_EQ(run({"refocus", "a.lens.exr", "--html", "a.html"}).exitCode, 0);
    const std::string page = textIn("a.html");
    EXPECT_LT(page.size(), 12'000'000u);
    EXPECT_EQ(page.find("@PAGE_"), std::string::npos);
    for (const char* outside : {"http:", "https:", "src=", "href=", "@import"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(RefocusCommand, filmsFocusPulls) {
    ASSERT_EQ(lensImages({"--samples", "4", "--focus-range", "2:5", "--lens-images", "a.exr"}).exitCode, 0);
    const std::size_t files = fileCount();
    const auto film = [&](const std::string& frames, const std::string& rate) {
        const Outcome outcome = run(
            {"refocus", "a.exr", "--focus-pull", "5:2", "--video", "a.gif", "--frames", frames, "--frame-rate", rate});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return textIn("a.gif");
    };
    const std::string two = film("2", "10");
    EXPECT_TRUE(two.starts_with("GIF8"));
    EXPECT_NE(film("3", "10"), two);
    EXPECT_NE(film("2", "20"), two);
    EXPECT_EQ(fileCount(), files + 1);  // the temporary frames of the video are removed
}

TEST_F(RefocusCommand, refusesWhatWasNotRendered) {
    ASSERT_EQ(lensImages({"--samples", "4", "--focus-range", "2:5", "--lens-images", "a.exr"}).exitCode, 0);
    expectRefused({"refocus", "a.exr", "--focus-distance", "1"}, "outside the rendered range of 2 to 5 m");
    expectRefused({"refocus", "a.exr", "--fstop", "0.7"}, "--fstop 0.7");
    expectRefused({"refocus", "a.exr", "--focus-pixel", "64,0"}, "64x48");
    expectRefused({"refocus", "a.exr", "--focus-pull", "1:4", "--video", "a.mp4"}, "outside the rendered range");
    expectRefused({"refocus", "a.exr", "--stack", "4", "--focus-distance", "3"}, "--focus-distance", 2);
    expectRefused({"refocus", "a.exr", "--html", "a.txt"}, ".html", 2);
    expectRefused({"refocus", "a.exr", "--html", "a.html", "--blades", "5"}, "--html", 2);
    expectRefused({"refocus", "quads.gltf"}, "quads.gltf");
    expectRefused({"refocus", "missing.exr"}, "missing.exr");

    ASSERT_EQ(lensImages({"--samples", "4", "--blades", "6", "--lens-images", "b.exr"}).exitCode, 0);
    expectRefused({"refocus", "b.exr", "--blades", "5"}, "b.exr");
    EXPECT_EQ(run({"refocus", "b.exr", "--quiet"}).exitCode, 0);
}

TEST_F(RefocusCommand, refusesDamagedFiles) {
    ASSERT_EQ(lensImages({"--samples", "4", "--lens-images", "a.exr"}).exitCode, 0);
    const fs::path whole = folder() / "a.exr";
    const auto size = fs::file_size(whole);
    for (const auto bytes : {size - 1000, size / 2, std::uintmax_t{500}}) {
        fs::copy_file(whole, folder() / "cut.exr", fs::copy_options::overwrite_existing);
        fs::resize_file(folder() / "cut.exr", bytes);
        expectRefused({"refocus", "cut.exr"}, "cut.exr");
    }
    writeImage(folder() / "one.exr", Image(4, 4, 4), Metadata());
    expectRefused({"refocus", "one.exr"}, "render --lens-images");
}

TEST_F(RefocusCommand, refusesToRenderOtherFiles) {
    const auto line = [](const Words& more) {
        Words words = {"render", "quads.gltf", "--size", "64x48", "--lens-images", "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    expectRefused({"render", "quads.gltf", "--lens-images", "a.png"}, ".exr", 2);
    expectRefused(line({"--method", "circular"}), "accumulation", 2);
    expectRefused(line({"--target-error", "0.1"}), "--samples", 2);
    expectRefused(line({"--samples", "2000"}), "1024", 2);
    expectRefused(line({"-o", "b.exr"}), "--lens-images", 2);
    expectRefused(line({"--focus-range", "3:2"}), "3:2", 2);
    expectRefused(line({"--focus-range", "3"}), "NEAR:FAR", 2);
    expectRefused({"render", "quads.gltf", "--focus-range", "2:3"}, "--lens-images", 2);
    expectRefused(line({"--cat-eye", "0.5"}), "--cat-eye");
}

}  // namespace
}  // namespace defocus::engine
