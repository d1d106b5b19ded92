// Tests the division of a frame into bands (ranges of rows) and tiles. Bands cover the frame without overlap and fit
// into the available memory.

#include "render/tiles/tiling.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "render/tiles/tile_walk.h"

namespace defocus::engine {
namespace {

TilingNeeds needsOf(int width, int height, std::uint64_t memory) {
    TilingNeeds needs;
    needs.width = width;
    needs.height = height;
    needs.rows = {0, height};
    needs.waveBytes = std::uint64_t{256} << 20;
    needs.deviceMemory = needs.hostMemory = memory;
    return needs;
}

// Returns the bytes that the largest tile needs, including the sample layers and the band that it belongs to.
std::uint64_t bytesOf(const TilingNeeds& needs, const Tiling& tiling) {
    std::uint64_t max = 0;
    for (const Band& band : tiling.bands)
        for (const Tile& tile : band.tiles) {
            const auto pixels = [](const PixelRectangle& area) {
                return static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
            };
            max = std::max(max, pixels(tile.cell) * needs.layerPixel * tiling.wave +
                                    pixels(tile.area) * (sumPixelBytes + tilePixelBytes) +
                                    static_cast<std::uint64_t>(needs.width) *
                                        static_cast<std::uint64_t>(band.rows.end - band.rows.first) * bandPixelBytes);
        }
    return max;
}

TEST(Tiling, coversTheRowsOnceWithinTheMemory) {
    for (const auto& [width, height, memory] :
         {std::tuple{640, 480, 20ull << 20}, {4000, 3000, 400ull << 20}, {16384, 16384, 2500ull << 20}}) {
        TilingNeeds needs = needsOf(width, height, memory);
        needs.rows = {height / 10, height - 3};
        const Tiling tiling = chosenTiling(needs);
        EXPECT_LE(bytesOf(needs, tiling), memory);
        EXPECT_GT(tiling.bands.size(), 1u);
        int next = needs.rows.first;
        for (const Band& band : tiling.bands) {
            EXPECT_EQ(band.rows.first, next);
            next = band.rows.end;
            int column = 0;
            for (const Tile& tile : band.tiles) {
                EXPECT_EQ(tile.area.left, column);
                column += tile.area.width;
                EXPECT_EQ(tile.area.top, band.rows.first);
                EXPECT_EQ(tile.area.height, band.rows.end - band.rows.first);
                EXPECT_LE(tile.cell.top, tile.area.top);
                EXPECT_GE(tile.cell.top + tile.cell.height, tile.area.top + tile.area.height);
            }
            EXPECT_EQ(column, width);
        }
        EXPECT_EQ(next, needs.rows.end);
    }
}

TEST(Tiling, bandsAreOfOneHeightWhereAFewMoreMakeThem) {
    const TilingNeeds needs = needsOf(4096, 3072, 450 << 20);
    const Tiling tiling = chosenTiling(needs);
    EXPECT_GT(tiling.bands.size(), 4u);
    for (const Band& band : tiling.bands)
        EXPECT_EQ(band.rows.end - band.rows.first, tiling.bands.front().rows.end) << band.rows.first;
    const TilingNeeds prime = needsOf(4096, 3067, 450 << 20);
    EXPECT_LE(chosenTiling(prime).bands.size(), tiling.bands.size() + tiling.bands.size() / 2);
}

TEST(Tiling, onePieceIsWhatFitsWithItsPicture) {
    const std::uint64_t pixel = 12 + sumPixelBytes + untiledPixelBytes;
    EXPECT_TRUE(fitsInOnePiece(needsOf(100, 100, 10'000 * pixel)));
    EXPECT_FALSE(fitsInOnePiece(needsOf(100, 100, 10'000 * pixel - 1)));
    // An image of several rasterization cells (areas of at most 8192 px on a side) is always divided, so that its bits
    // do not depend on the available memory.
    EXPECT_FALSE(fitsInOnePiece(needsOf(16384, 16, 1ull << 50)));
    TilingNeeds oneCell = needsOf(16384, 16, 1ull << 50);
    oneCell.mayUseCells = false;
    EXPECT_TRUE(fitsInOnePiece(oneCell));
}

// Data layers take host memory twice, in addition to the rendered image: for their sums and for their finished images.
TEST(Tiling, dataLayersTakeMemoryTwice) {
    TilingNeeds needs = needsOf(100, 100, 10'000 * (12 + sumPixelBytes + untiledPixelBytes + 2 * 96));
    needs.dataPixel = 96;
    EXPECT_TRUE(fitsInOnePiece(needs));
    needs.dataPixel = 97;
    EXPECT_FALSE(fitsInOnePiece(needs));
}

TEST(Tiling, aDeviceWithMemoryOfItsOwnIsLookedAtApart) {
    TilingNeeds needs = needsOf(1000, 1000, 100 << 20);
    needs.shared = false;
    const Tiling plenty = chosenTiling(needs);
    needs.hostMemory = 1000 * (tilePixelBytes + bandPixelBytes) * 20;  // enough memory for twenty rows
    EXPECT_GT(chosenTiling(needs).bands.size(), plenty.bands.size());
    EXPECT_EQ(chosenTiling(needs).bands.size(), 50u);
}

TEST(Tiling, tooLittleMemorySaysWhatIsNeeded) {
    try {
        chosenTiling(needsOf(4096, 4096, 50 << 20));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("50 MiB is left"), std::string::npos) << error.what();
    }
}

TEST(Tiling, picturesThatAreKeptLeaveLess) {
    TilingNeeds needs = needsOf(1000, 1000, 120 << 20);
    const Tiling alone = chosenTiling(needs);
    needs.keptBytes = 90'000'000;
    const Tiling beside = chosenTiling(needs);
    EXPECT_GT(beside.bands.size(), alone.bands.size());
    EXPECT_LE(bytesOf(needs, beside) + needs.keptBytes, 120u << 20);
    needs.keptBytes = 120 << 20;
    EXPECT_THROW(chosenTiling(needs), Error);
}

TEST(Tiling, shadowMapsTakeTheMemoryOfSamplesAtOnce) {
    TilingNeeds needs = needsOf(640, 480, 200 << 20);
    const std::uint64_t layer = std::uint64_t{640} * 480 * needs.layerPixel;
    const std::uint32_t alone = chosenTiling(needs).wave;
    needs.layerMaps = layer;
    EXPECT_EQ(chosenTiling(needs).wave, alone / 2);
    needs.layerMaps = needs.deviceMemory;
    EXPECT_THROW(chosenTiling(needs), Error);
    EXPECT_FALSE(fitsInOnePiece(needs));
}

TEST(Tiling, theSamplesAtOnceAreThoseAskedFor) {
    TilingNeeds needs = needsOf(640, 480, 200 << 20);
    needs.askedWave = 3;
    EXPECT_EQ(chosenTiling(needs).wave, 3u);
}

// The times of a tiled frame are the sums over its tiles.
TEST(TileStats, timesOfTilesAreSummed) {
    RenderStats sum;
    for (const double milliseconds : {1.0, 2.0}) {
        RenderStats tile;
        tile.renderMilliseconds = milliseconds;
        tile.cpuTime = {2 * milliseconds, milliseconds};
        addTileStats(sum, tile);
    }
    EXPECT_EQ(sum.renderMilliseconds, 3);
    EXPECT_EQ(sum.cpuTime.milliseconds, 6);
    EXPECT_EQ(sum.cpuTime.busiestMilliseconds, 3);
}

}  // namespace
}  // namespace defocus::engine
