// Tests `defocus render --exr-layers` and the files that it writes.

#include <cstdlib>

#include "cli/gl_program.h"
#include "cli/option_cases.h"
#include "image/metrics.h"

namespace defocus::engine {
namespace {

class RenderLayers : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        writeOptionScene(folder());
    }

    [[nodiscard]] Outcome render(std::vector<std::string> words) const {
        words.insert(words.begin(), {"render", "ball.glb", "--size", "32x24", "--samples", "8", "--fstop", "0.3"});
        return run(words);
    }
};

TEST_F(RenderLayers, thePictureIsThatOfTheAccumulation) {
    ASSERT_EQ(render({"--method", "accumulation", "-o", "plain.exr"}).exitCode, 0);
    for (const char* names : {"nuke", "blender"}) {
        const Outcome outcome = render({"--exr-layers", "all", "--exr-names", names, "-o", "layers.exr"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const Image plain = readImage(folder() / "plain.exr");
        const Image layers = readImage(folder() / "layers.exr");
        ASSERT_EQ(layers.channels, plain.channels);
        for (std::size_t i = 0; i < plain.pixels.size(); ++i) ASSERT_NEAR(layers.pixels[i], plain.pixels[i], 1e-3) << i;
    }
}

TEST_F(RenderLayers, channelsHaveTheNamesOfOtherPrograms) {
    if (std::system("command -v iinfo >/dev/null") != 0) GTEST_SKIP() << "iinfo is not installed";
    const auto printed = [&](const char* names) {
        EXPECT_EQ(render({"--exr-layers", "all", "--exr-names", names, "-o", "layers.exr"}).exitCode, 0);
        const std::string file = (folder() / "layers.exr").string();
        EXPECT_EQ(std::system(("iinfo -v " + file + " >" + file + ".txt").c_str()), 0);
        return textOf(folder() / "layers.exr.txt");
    };
    const std::string nuke = printed("nuke");
    for (const char* part :
         {"R, G, B", "N.X", "P.Z", "depth.Z", "depth_nearest.Z", "albedo.R", "emission.B", "motion.Y", "coc.X",
          "coverage.A", "CryptoObject02.A", "CryptoMaterial00.R", "cryptomatte/3ae39a5/name: \"CryptoObject\"",
          "cryptomatte/3ae39a5/hash: \"MurmurHash3_32\"", "cryptomatte/3ae39a5/conversion: \"uint32_to_float32\"",
          "Ball"})
        EXPECT_NE(nuke.find(part), std::string::npos) << part << "\n" << nuke;
    const std::string blender = printed("blender");
    for (const char* part : {"ViewLayer.Combined.R", "ViewLayer.Normal.X", "ViewLayer.Depth.Z",
                             "ViewLayer.CryptoObject00.R", "\"ViewLayer.CryptoObject\""})
        EXPECT_NE(blender.find(part), std::string::npos) << part << "\n" << blender;
}

TEST_F(RenderLayers, areRefusedWhereTheyCannotBeDrawn) {
    const auto refuse = [&](std::vector<std::string> words, int exitCode, const char* part) {
        words.insert(words.end(), {"--exr-layers", "depth,motion"});
        const Outcome outcome = render(words);
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    };
    refuse({"--method", "multirate", "-o", "a.exr"}, 2, "method multirate cannot draw the layers");
    refuse({"--method", "circular", "-o", "a.exr"}, 2, "method circular cannot draw the layers");
    refuse({"-o", "a.png"}, 1, ".exr");
    refuse({"-o", "a.exr", "--keep-partial"}, 1, "--keep-partial");
    refuse({"-o", "a.exr", "--shutter", "1", "--motion-segments", "exact"}, 2, "--motion-segments exact");
    expectOneLine(render({"--exr-layers", "depth,fog"}), 2);
    const Outcome plan = run({"plan", "ball.glb", "--fstop", "0.3", "--exr-layers", "depth"});
    EXPECT_NE(plan.out.find("--method auto selects accumulation, because the layers"), std::string::npos) << plan.out;
}

TEST_F(RenderLayers, filmsHaveThem) {
    writeFile(folder() / "film.json",
              std::string_view(R"({"scene": "ball.glb", "size": [32, 24], "range": [0, 1], "output": "film/#.exr"})"));
    const Outcome outcome = run({"capture", "film.json", "--samples", "4", "--exr-layers", "depth,objects"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    Metadata metadata;
    EXPECT_EQ(readImage(folder() / "film/1.exr", metadata).channels, 4);
    EXPECT_TRUE(metadata.contains("cryptomatte/3ae39a5/manifest"));
    EXPECT_TRUE(metadata.at("framesPerSecond") == MetadataValue(Rational{24, 1}));
    EXPECT_TRUE(metadata.at("timeCode") == MetadataValue(TimeCode{0, 0, 0, 1}));
}

}  // namespace
}  // namespace defocus::engine
