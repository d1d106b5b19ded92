// Tests `defocus capture --refocus`: frames of a still scene are refocused from lens images (views from points of the
// lens), and other frames are rendered.

#include "cli/shots.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class CaptureRefocus : public Capture {
protected:
    // Returns a shot in which only the focus distance changes, with 64 samples per frame.
    static json focusPull() {
        json document = shot();
        document.erase("camera");
        document["samples"] = 64;
        document["lens"] = {{"fStop", 1.4}};
        return document;
    }

    static fs::path frame(const std::string& folder, int number) {
        return fs::path(folder) / ("000" + std::to_string(number) + ".exr");
    }

    Outcome filmed(const std::string& folder, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"capture", "shot.json", "-o", folder + "/####.exr"});
        return run(more);
    }
};

TEST_F(CaptureRefocus, picturesAreThoseOfRenders) {
    writeShot(focusPull());
    const Outcome plain = filmed("plain", {"--method", "accumulation"});
    ASSERT_EQ(plain.exitCode, 0) << plain.err;
    EXPECT_NE(plain.err.find("--refocus would compute 8 frames from 64 lens images instead of 512 lens samples"),
              std::string::npos)
        << plain.err;
    const Outcome refocused = filmed("refocused", {"--refocus"});
    ASSERT_EQ(refocused.exitCode, 0) << refocused.err;
    EXPECT_NE(refocused.err.find("refocused 8 frames from 64 lens images instead of 512 lens samples"),
              std::string::npos)
        << refocused.err;
    for (int number = 0; number < 8; ++number) {
        Metadata rendered;
        Metadata computed;
        const Image a = readImage(folder() / frame("plain", number), rendered);
        const Image b = readImage(folder() / frame("refocused", number), computed);
        EXPECT_GT(compareImages(a, b).psnr, 32) << number;
        EXPECT_NE(a.pixels, b.pixels) << number;
        EXPECT_NE(rendered.at("defocus:settings"), computed.at("defocus:settings"));
        for (const char* same : {"focus", "aperture", "defocus:horizontalAperture", "defocus:frame", "defocus:samples"})
            EXPECT_EQ(rendered.at(same), computed.at(same)) << same;
    }
}

// A frame depends only on the shot, not on the frames that are rendered with it.
TEST_F(CaptureRefocus, aFrameIsTheSameBitsHoweverItIsRendered) {
    writeShot(focusPull());
    ASSERT_EQ(filmed("all", {"--refocus"}).exitCode, 0);
    ASSERT_EQ(filmed("alone", {"--refocus", "--range", "5"}).exitCode, 0);
    ASSERT_EQ(filmed("shard", {"--refocus", "--shard", "2/3"}).exitCode, 0);
    EXPECT_TRUE(bytesOf(frame("alone", 5)) == bytesOf(frame("all", 5)));
    EXPECT_TRUE(bytesOf(frame("shard", 5)) == bytesOf(frame("all", 5)));
    const Outcome resumed = filmed("all", {"--refocus", "--resume"});
    EXPECT_NE(resumed.err.find("8 frames, 8 of them from earlier runs"), std::string::npos) << resumed.err;
    expectOneLine(filmed("all", {"--resume"}), 1);  // fails, since the existing frames have other settings
}

// The aperture closes by two stops, to a quarter of its area. Thus 4 · 64 lens images (views from lens points) give the
// last frame 64 samples.
TEST_F(CaptureRefocus, smallAperturesHaveAsManySamples) {
    json document = focusPull();
    document["lens"] = {{"fStop", {{"keys", {{{"frame", 0}, {"value", 1.4}}, {{"frame", 7}, {"value", 2.8}}}}}},
                        {"bladeCount", {{"keys", {{{"frame", 0}, {"value", 0}}, {{"frame", 7}, {"value", 6}}}}}}};
    writeShot(document);
    const Outcome outcome = filmed("pull", {"--refocus"});
    EXPECT_NE(outcome.err.find("refocused 8 frames from 256 lens images instead of 512"), std::string::npos)
        << outcome.err;
    const auto samples = [&](int number) {
        Metadata metadata;
        static_cast<void>(readImage(folder() / frame("pull", number), metadata));
        return std::get<int>(metadata.at("defocus:samples"));
    };
    EXPECT_EQ(samples(0), 256);
    EXPECT_NEAR(samples(7), 64 * 0.827, 4);  // the hexagon has 82.7 % of the disk's area
    // Closing by four stops, to 1/16 of the area, needs 16 · 64 = 1024 lens images to give the last frame 64 samples.
    document["lens"]["fStop"]["keys"][1]["value"] = 5.6;
    writeShot(document);
    const std::string plan = filmed("far", {"--refocus", "--dry-run"}).out;
    // The plan uses several small sets of lens images (views from lens points), one per run of frames: they have fewer
    // images in total than one set of 1024 for all frames.
    EXPECT_NE(plan.find("0000.exr (refocused)"), std::string::npos) << plan;
}

// Frames with the same hexagonal aperture are computed from images of a hexagon. If one of them has another shape, all
// are computed from images of a disk. --resume then rejects the earlier frames, since their settings differ.
TEST_F(CaptureRefocus, resumingNoticesOtherLensImages) {
    json document = focusPull();
    document["lens"]["bladeCount"] = 6;
    writeShot(document);
    ASSERT_EQ(filmed("pull", {"--refocus", "--range", "0:6"}).exitCode, 0);
    document["lens"]["bladeCount"] = {
        {"keys", {{{"frame", 0}, {"value", 6}}, {{"frame", 6}, {"value", 6}}, {{"frame", 7}, {"value", 0}}}}};
    writeShot(document);
    const Outcome resumed = filmed("pull", {"--refocus", "--resume"});
    EXPECT_EQ(resumed.exitCode, 1);
    EXPECT_NE(resumed.err.find("other settings"), std::string::npos) << resumed.err;
}

TEST_F(CaptureRefocus, framesWithMotionStayTheSame) {
    ASSERT_EQ(filmed("plain", {"--method", "accumulation"}).exitCode, 0);
    const Outcome outcome = filmed("moving", {"--refocus"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("--refocus has no effect"), std::string::npos) << outcome.err;
    for (int number = 0; number < 8; ++number)
        EXPECT_TRUE(bytesOf(frame("plain", number)) == bytesOf(frame("moving", number))) << number;
}

TEST_F(CaptureRefocus, saysWhyALensCannotBeRefocused) {
    json document = focusPull();
    document["lens"]["focusBreathing"] = true;
    writeShot(document);
    const Outcome outcome = filmed("pull", {"--refocus", "--samples", "4"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_NE(outcome.err.find("frames 0 to 7 are rendered one by one: lens images cannot be combined with "
                               "--focus-breathing"),
              std::string::npos)
        << outcome.err;
}

TEST_F(CaptureRefocus, refusesOtherMethodsAndParts) {
    writeShot(focusPull());
    const std::vector<std::vector<std::string>> wrong = {{"--method", "circular"},
                                                         {"--sample-range", "0:64"},
                                                         {"--check"},
                                                         {"--target-error", "0.1"},
                                                         {"--exr-layers", "depth"}};
    for (std::vector<std::string> more : wrong) {
        more.emplace_back("--refocus");
        const Outcome outcome = filmed("wrong", more);
        expectOneLine(outcome, 2);
        EXPECT_NE(outcome.err.find("--refocus"), std::string::npos) << outcome.err;
    }
    const Outcome large = filmed("large", {"--refocus", "--memory", "2MB"});
    expectOneLine(large, 1);
    EXPECT_NE(large.err.find("--refocus needs"), std::string::npos) << large.err;
}

}  // namespace
}  // namespace defocus::engine
