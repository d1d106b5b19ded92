// Tests that frames drawn in tiles are bit-identical to a frame without tiles, even if several machines draw the tiles.
// Tiles of different frames are not merged.

#include "cli/tile_command.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

TEST_F(TileCommand, mergedTilesAreTheBitsOfOnePiece) {
    for (const std::string background : {"environment", "none"}) {
        const std::vector<std::string> more = {"--background", background, "--lod", "continuous"};
        std::vector<std::string> parts = {"merge", "--quiet", "-o", "merged.exr", "-o", "merged.png"};
        for (const std::string index : {"2", "0", "1"}) {
            const std::string name = "tile" + index + ".exr";
            const Outcome outcome = tile(index + "/3", name, more);
            ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
            parts.push_back(name);
        }
        std::vector<std::string> full = line(more);
        full.insert(full.end(), {"-o", "whole.exr", "-o", "whole.png"});
        ASSERT_EQ(run(full).exitCode, 0);
        const Outcome merged = run(parts);
        ASSERT_EQ(merged.exitCode, 0) << merged.err;
        EXPECT_TRUE(pixelsOf("merged.exr") == pixelsOf("whole.exr")) << background;
        EXPECT_TRUE(pixelsOf("merged.png") == pixelsOf("whole.png")) << background;
        Metadata metadata;
        readImage(folder() / "merged.exr", metadata);
        EXPECT_EQ(std::get<int>(metadata.at("defocus:samples")), 70);
        EXPECT_FALSE(metadata.contains("defocus:tile"));
    }
}

// Without --samples, each tile has the number of samples that the blur of the entire frame requires.
TEST_F(TileCommand, tilesAgreeOnTheNumberOfSamples) {
    std::vector<std::string> parts = {"merge", "--quiet", "-o", "merged.exr"};
    for (const std::string index : {"0", "1"}) {
        const std::string name = "tile" + index + ".exr";
        ASSERT_EQ(
            run({"render", "quads.gltf", "--quiet", "--size", "64x48", "--tile", index + "/2", "-o", name}).exitCode,
            0);
        parts.push_back(name);
    }
    EXPECT_EQ(run(parts).exitCode, 0);
}

TEST_F(TileCommand, whatIsMissingOrForeignIsNamed) {
    for (const std::string index : {"0", "1", "2"}) ASSERT_EQ(tile(index + "/3", index + ".exr").exitCode, 0);
    ASSERT_EQ(tile("1/3", "other.exr", {"--seed", "1"}).exitCode, 0);
    ASSERT_EQ(tile("0/2", "half.exr").exitCode, 0);
    const auto merged = [&](std::vector<std::string> parts) {
        parts.insert(parts.begin(), {"merge", "-o", "merged.exr"});
        const Outcome outcome = run(parts);
        EXPECT_FALSE(fs::exists(folder() / "merged.exr"));
        return outcome;
    };
    expectRefused(merged({"0.exr", "2.exr"}), 1,
                  "a tile of the frame is missing: rows 16 to 31 of 48; render it with --tile 1/3");
    expectRefused(merged({"1.exr", "2.exr"}), 1, "tile 0/3");
    expectRefused(merged({"0.exr", "1.exr"}), 1, "tile 2/3");
    expectRefused(merged({"0.exr", "gone.exr", "2.exr"}), 1, "cannot read gone.exr: No such file");
    expectRefused(merged({"0.exr", "0.exr", "1.exr", "2.exr"}), 1, "overlap: both hold row 0");
    expectRefused(merged({"half.exr", "1.exr", "2.exr"}), 1, "overlap");
    expectRefused(merged({"0.exr", "other.exr", "2.exr"}), 1, "different frames: seed differs (0 and 1)");
    expectRefused(merged({"0.exr", "quads.gltf", "2.exr"}), 1, "quads.gltf: ");
    ASSERT_EQ(run(line({"-o", "whole.exr"})).exitCode, 0);
    expectRefused(merged({"0.exr", "whole.exr"}), 1, "whole.exr is not a tile of a frame");
}

TEST_F(TileCommand, whatDoesNotGoWithTilesIsRefused) {
    expectOneLine(tile("3/3", "x.exr"), 2);
    expectOneLine(tile("1", "x.exr"), 2);
    expectOneLine(tile("0/0", "x.exr"), 2);
    expectRefused(tile("0/49", "x.exr"), 1, "the image has only 48 rows");
    expectRefused(tile("0/2", "x.png"), 2, "EXR");
    for (const char* method : {"circular", "scheuermann", "multirate", "line", "stochastic"})
        expectRefused(tile("0/2", "x.exr", {"--method", method}), 2, std::string("'") + method + "'");
    expectRefused(tile("0/2", "x.exr", {"--target-error", "0.01"}), 2, "--target-error");
    expectRefused(tile("0/2", "x.exr", {"--aov", "depth"}), 2, "--aov");
    expectRefused(run(line({"--resume"})), 2, "this frame fits into memory");
}

}  // namespace
}  // namespace defocus::engine
