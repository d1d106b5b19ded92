// Tests that a frame whose pixels exceed the memory limit is drawn in tiles. It is bit-identical to a frame without
// tiles, and memory stays within the limit.

#include <algorithm>
#include <string>

#include "cli/tile_command.h"
#include "gl/context.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

// Fixture that renders frames that would exceed the memory limit if they were not divided into tiles.
class ShortOfMemory : public TileCommand {
protected:
    static constexpr const char* size = "2400x1800";
    // Without tiles, the frame's pixels take 880 MB, of which a layer (the image of one lens sample) takes 50 MB.
    static std::vector<std::string> inTiles(std::vector<std::string> more, const char* memory = "350MiB") {
        more.insert(more.end(), {"--memory", memory});
        return line(more, size, "3");
    }

    // Returns the value that an error message recommends for --memory, such as "320MiB".
    static std::string recommended(const Outcome& refusal) {
        const std::string option = "--memory ";
        const std::size_t begin = refusal.err.find(option);
        if (begin == std::string::npos) {
            ADD_FAILURE() << refusal.err;
            return {};
        }
        const std::size_t value = begin + option.size();
        return refusal.err.substr(value, refusal.err.find(' ', value) - value);
    }
};

TEST_F(ShortOfMemory, theFrameHasTheBitsOfOnePiece) {
    const Outcome outcome = run(inTiles({"-o", "tiles.exr", "-o", "tiles.png", "--stats", "stats.json"}));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "tiles.tiles"));
    ASSERT_EQ(run(line({"-o", "whole.exr", "-o", "whole.png"}, size, "3")).exitCode, 0);
    EXPECT_TRUE(pixelsOf("tiles.exr") == pixelsOf("whole.exr"));
    EXPECT_TRUE(pixelsOf("tiles.png") == pixelsOf("whole.png"));
    const auto stats = nlohmann::json::parse(textOf(folder() / "stats.json"));
    EXPECT_LE(stats.at("peakBytes").get<double>(), 1.1 * (350 << 20));
    EXPECT_GT(stats.at("tiles").get<int>(), 1);
}

TEST_F(ShortOfMemory, whatCannotBeCutIsRefusedByName) {
    expectRefused(run(inTiles({"-o", "x.exr", "--method", "circular"}, "300MiB")), 1, "'circular'");
    expectRefused(run(inTiles({"-o", "x.exr", "--aov", "depth"}, "300MiB")), 1, "--aov");
    expectRefused(run(inTiles({"-o", "x.exr"}, "1MiB")), 1, "at least");
    EXPECT_FALSE(fs::exists(folder() / "x.tiles"));
}

// Meshes and the driver's copies of their triangles count towards the memory limit before the program allocates them.
// Each lens sample draws 400,000 triangles. The frame is drawn without tiles.
TEST_F(ShortOfMemory, aHeavySceneInOnePieceKeepsToIt) {
    const Outcome outcome =
        run({"render", "--quiet", "--fish", "20", "--fish-triangles", "20000", "--size", "1024x768", "--samples", "16",
             "--lod", "off", "--memory", "500MiB", "-o", "a.exr", "--stats", "stats.json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto stats = nlohmann::json::parse(textOf(folder() / "stats.json"));
    EXPECT_EQ(stats.at("tiles"), 1);
    EXPECT_LE(stats.at("peakBytes").get<double>(), 1.1 * (500 << 20));
}

// Tiles at the top of the image show few of the objects. The objects that a tile does not show also count towards the
// limit, because they occupy memory.
TEST_F(ShortOfMemory, aFineSceneInTilesKeepsToIt) {
    const Outcome outcome = run({"render", "--quiet", "--fish", "6", "--size", "1024x768", "--samples", "16", "--lod",
                                 "off", "--memory", "400MiB", "-o", "a.exr", "--stats", "stats.json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto stats = nlohmann::json::parse(textOf(folder() / "stats.json"));
    EXPECT_GT(stats.at("tiles").get<int>(), 1);
    EXPECT_LE(stats.at("peakBytes").get<double>(), 400 << 20);
}

// If the driver's copies of fine meshes leave too little memory for the image, the error message names a memory limit
// that is sufficient. A run with this limit stays within it.
TEST_F(ShortOfMemory, aFineSceneKeepsToTheMemoryThatIsSaidToDo) {
    if (!createHeadlessContext()->software()) GTEST_SKIP() << "no option limits a GPU's own memory";
    const auto fish = [&](const std::string& memory) {
        return run({"render", "--quiet", "--fish", "3", "--size", "1024x768", "--samples", "16", "--lod", "off",
                    "--memory", memory, "-o", "a.exr", "--stats", "stats.json"});
    };
    for (std::string memory : {"230MiB", "300MiB"}) {
        SCOPED_TRACE(memory);
        Outcome outcome = fish(memory);
        if (outcome.exitCode != 0) {
            memory = recommended(outcome);
            outcome = fish(memory);
        }
        ASSERT_EQ(outcome.exitCode, 0) << memory << ": " << outcome.err;
        const auto stats = nlohmann::json::parse(textOf(folder() / "stats.json"));
        EXPECT_LE(stats.at("peakBytes").get<double>(), std::stod(memory) * (1 << 20)) << memory;
    }
}

// A run with enough memory resumes from the tiles that a run with little memory has finished.
TEST_F(ShortOfMemory, resumedWithMoreMemoryItGoesOn) {
    fs::create_directory(folder() / "a.tiles");
    ASSERT_EQ(run(line({"--resume", "-o", "a.exr"})).exitCode, 0);
    ASSERT_EQ(run(line({"-o", "whole.exr"})).exitCode, 0);
    EXPECT_TRUE(pixelsOf("a.exr") == pixelsOf("whole.exr"));
    EXPECT_FALSE(fs::exists(folder() / "a.tiles"));
}

TEST_F(ShortOfMemory, theMemoryThatIsSaidToDoDoes) {
    if (!createHeadlessContext()->software()) GTEST_SKIP() << "no option limits a GPU's own memory";
    const std::string enough = recommended(run(inTiles({"-o", "x.exr"}, "1MiB")));
    const Outcome outcome = run(inTiles({"-o", "x.exr"}, enough.c_str()));
    EXPECT_EQ(outcome.exitCode, 0) << enough << ": " << outcome.err;
}

// Frames of a sequence are also drawn in tiles, and their files are byte-identical to files drawn without tiles.
TEST_F(ShortOfMemory, aFilmHasTheBytesOfFramesInOnePiece) {
    const auto film = [&](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"--range", "0:1", "--size", "1600x1200", "--samples", "3", "-o", name + "/#.exr",
                                   "-o", name + "/#.png", "-o", name + "/#.jpg"});
        return capture(more);
    };
    ASSERT_EQ(film("whole", {}).exitCode, 0);
    const Outcome tiles = film("tiles", {"--memory", "350MiB"});
    ASSERT_EQ(tiles.exitCode, 0) << tiles.err;
    for (const char* name : {"0.exr", "0.png", "0.jpg", "1.exr", "1.png", "1.jpg"})
        EXPECT_TRUE(bytesOf(std::string("tiles/") + name) == bytesOf(std::string("whole/") + name)) << name;
    // --resume keeps finished frames, whether or not they were drawn in tiles.
    EXPECT_NE(run({"capture", "shot.json", "--range", "0:1", "--size", "1600x1200", "--samples", "3", "-o",
                   "tiles/#.exr", "--memory", "350MiB", "--resume"})
                  .err.find("2 of them from earlier runs"),
              std::string::npos);
}

TEST_F(ShortOfMemory, whatAFilmCannotCutIsRefusedByName) {
    const auto refused = [&](std::vector<std::string> more, const std::string& why) {
        more.insert(more.begin(), {"--range", "0:1", "--size", size, "-o", "x/#.exr", "--memory", "300MiB"});
        expectRefused(capture(more), 1, why);
    };
    refused({"--method", "circular"}, "'circular'");
    refused({"--target-error", "0.01"}, "--target-error");
    refused({"--samples", "128", "--sample-range", "0:64"}, "--sample-range");
}

TEST_F(ShortOfMemory, samplesThatTheBlurAloneChoseAreSaid) {
    std::vector<std::string> words = inTiles({"-o", "x.exr"});
    words.erase(std::ranges::find(words, "--quiet"));
    *(std::ranges::find(words, "--samples") + 1) = "auto";
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("lens samples, a number estimated from the blur"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace defocus::engine
