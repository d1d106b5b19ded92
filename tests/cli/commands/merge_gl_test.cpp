// Tests that files with parts of a frame's samples merge into a file that is bit-identical to a single run's, and that
// parts of different frames are rejected.

#include <algorithm>

#include "cli/shots.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class Merge : public Capture {
protected:
    Outcome part(const std::string& range, const std::string& output, std::vector<std::string> more = {}) const {
        std::vector<std::string> words = {"render", "quads.gltf",       "--quiet", "--size",         "64x48", "--fstop",
                                          "1",      "--samples",        "150",     "--sample-range", range,   "-o",
                                          output,   "--focus-distance", "3"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    [[nodiscard]] std::vector<float> pixelsOf(const std::string& name) const {
        return readImage(folder() / name).pixels;
    }
};

TEST_F(Merge, partsGiveTheBitsOfASingleRun) {
    for (const std::string background : {"environment", "none", "0.2,0.3,0.4"}) {
        const std::vector<std::string> more = {"--background", background, "--lod", "continuous"};
        ASSERT_EQ(part("0:64", "a.exr", more).exitCode, 0);
        ASSERT_EQ(part("64:150", "b.exr", more).exitCode, 0);
        std::vector<std::string> full = {"render", "quads.gltf", "--quiet", "--size", "64x48",     "--fstop",
                                         "1",      "--samples",  "150",     "-o",     "whole.exr", "--focus-distance",
                                         "3"};
        full.insert(full.end(), more.begin(), more.end());
        ASSERT_EQ(run(full).exitCode, 0);
        const Outcome merged = run({"merge", "b.exr", "a.exr", "-o", "merged.exr", "-o", "merged.png"});
        ASSERT_EQ(merged.exitCode, 0) << merged.err;
        EXPECT_EQ(pixelsOf("merged.exr"), pixelsOf("whole.exr")) << background;
        Metadata metadata;
        readImage(folder() / "merged.exr", metadata);
        EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 150);
        EXPECT_FALSE(metadata.contains("defocus:firstSample"));
    }
}

TEST_F(Merge, partsOfACaptureGiveItsFilesByteForByte) {
    nlohmann::json document = shot();
    document["samples"] = 128;
    writeShot(document);
    ASSERT_EQ(capture({"--range", "2", "-o", "f#.exr"}).exitCode, 0);
    ASSERT_EQ(capture({"--range", "2", "-o", "f#.exr", "--sample-range", "0:64"}).exitCode, 0);
    ASSERT_EQ(capture({"--range", "2", "-o", "f#.exr", "--sample-range", "64:128", "--resume"}).exitCode, 0);
    const std::string full = bytesOf("f2.exr");
    ASSERT_EQ(
        run({"merge", "--quiet", "f2.part00000-00064.exr", "f2.part00064-00128.exr", "-o", "merged.exr"}).exitCode, 0);
    EXPECT_TRUE(bytesOf("merged.exr") == full);
    // `capture --resume` treats the merged file as a finished frame and keeps it.
    fs::rename(folder() / "merged.exr", folder() / "f2.exr");
    const Outcome resumed = run({"capture", "shot.json", "--range", "2", "-o", "f#.exr", "--resume"});
    EXPECT_NE(resumed.err.find("1 of them from earlier runs"), std::string::npos) << resumed.err;
}

// Merged parts of a frame with motion blur equal a single run, since the time of a sample does not depend on the file
// that contains it. The camera rotates while the shutter is open.
TEST_F(Merge, partsOfAFrameWithMotionBlurGiveItsFileByteForByte) {
    nlohmann::json document = shot();
    document["samples"] = 150;
    writeShot(document);
    ASSERT_EQ(capture({"--range", "2", "-o", "still#.exr"}).exitCode, 0);
    for (const std::string segments : {"1", "4", "exact"}) {
        const auto film = [&](std::vector<std::string> more) {
            more.insert(more.end(),
                        {"--range", "2", "-o", "f#.exr", "--shutter", "1/24", "--motion-segments", segments});
            return capture(more).exitCode;
        };
        ASSERT_EQ(film({}), 0);
        const std::string full = bytesOf("f2.exr");
        for (const char* range : {"0:64", "64:128", "128:150"}) ASSERT_EQ(film({"--sample-range", range}), 0);
        ASSERT_EQ(run({"merge", "--quiet", "f2.part00128-00150.exr", "f2.part00000-00064.exr", "f2.part00064-00128.exr",
                       "-o", "merged.exr"})
                      .exitCode,
                  0);
        EXPECT_TRUE(bytesOf("merged.exr") == full) << segments;
        EXPECT_NE(pixelsOf("merged.exr"), pixelsOf("still2.exr")) << "nothing moves";
    }
}

TEST_F(Merge, aFrameThatNeedsFewerSamplesHasEmptyParts) {
    ASSERT_EQ(part("0:64", "a.exr", {"--no-dof", "--background", "none"}).exitCode, 0);
    ASSERT_EQ(part("64:150", "b.exr", {"--no-dof", "--background", "none"}).exitCode, 0);
    ASSERT_EQ(run({"merge", "--quiet", "a.exr", "b.exr", "-o", "merged.exr"}).exitCode, 0);
    ASSERT_EQ(run({"render", "quads.gltf", "--quiet", "--size", "64x48", "--samples", "150", "--no-dof", "--background",
                   "none", "--fstop", "1", "--focus-distance", "3", "-o", "whole.exr"})
                  .exitCode,
              0);
    EXPECT_EQ(pixelsOf("merged.exr"), pixelsOf("whole.exr"));
}

TEST_F(Merge, whatDoesNotFitTogetherIsRefused) {
    ASSERT_EQ(part("0:64", "a.exr").exitCode, 0);
    ASSERT_EQ(part("64:128", "b.exr").exitCode, 0);
    ASSERT_EQ(part("128:150", "c.exr").exitCode, 0);
    ASSERT_EQ(part("64:150", "bc.exr").exitCode, 0);
    ASSERT_EQ(part("128:150", "other.exr", {"--seed", "1"}).exitCode, 0);
    ASSERT_EQ(run({"render", "quads.gltf", "--quiet", "--size", "8x8", "--samples", "4", "-o", "whole.exr"}).exitCode,
              0);
    const auto refused = [&](const std::vector<std::string>& parts, const std::string& why) {
        std::vector<std::string> words = {"merge", "-o", "merged.exr"};
        words.insert(words.end(), parts.begin(), parts.end());
        const Outcome outcome = run(words);
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(folder() / "merged.exr"));
    };
    refused({"a.exr", "b.exr", "bc.exr"}, "overlap");
    refused({"a.exr", "a.exr", "bc.exr"}, "overlap");
    refused({"a.exr", "c.exr"}, "samples 64:128 of 150 are missing before part c.exr");
    refused({"b.exr", "c.exr"}, "samples 0:64");
    refused({"a.exr", "b.exr"}, "samples 128:150 are missing");
    refused({"a.exr", "b.exr", "other.exr"}, "different frames: seed differs (0 and 1)");
    refused({"a.exr", "whole.exr"}, "whole.exr: not an EXR file with layers");
    refused({"quads.gltf"}, "quads.gltf");
    expectOneLine(part("32:64", "x.exr"), 2);
    expectOneLine(part("0:32", "x.exr"), 1);
    expectOneLine(part("0:192", "x.exr"), 1);
    expectOneLine(part("0:64", "x.png"), 1);
    expectOneLine(part("0:64", "x.exr", {"--method", "circular"}), 2);
}

}  // namespace
}  // namespace defocus::engine
