// Tests that separately rendered blocks of samples add up to an image that is bit-identical to a single run, for every
// level mode and split.

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.h"
#include "frame/driver/frame_driver.h"
#include "gl_context_test.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class Partial : public GlContextTest {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "defocus-part-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    static RenderSettings settingsWith(LodMode mode) {
        return {.sampleCount = 150, .lod = mode, .thresholds = {0.5, 2}};
    }

    // Draws all samples, or only the samples in `range`. At most `wave` samples are drawn together (0: the default).
    static FrameDriver drawn(const SmallWorld& small, LodMode mode, std::optional<SampleRange> range,
                             std::uint32_t wave = 0) {
        FrameDriver driver(small.world, {parseMethodUse("accumulation"), {{}, wave}, {}});
        driver.start({small.view, settingsWith(mode), {}, range});
        while (driver.advance()) {
        }
        return driver;
    }

    fs::path folder_;
};

TEST_F(Partial, mergedBlocksAreTheSingleRun) {
    const auto small = fiveCoarseSpheres();
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous}) {
        const Image expected = drawn(*small, mode, {}).image();

        // Each range of samples is rendered by a separate driver and saved. The drivers have different limits on the
        // number of samples that are drawn at once (in a wave).
        std::vector<fs::path> paths;
        std::uint32_t wave = 3;
        for (const SampleRange& range : {SampleRange{0, 64}, SampleRange{64, 150}}) {
            FramePart part = drawn(*small, mode, range, wave += 4).sums();
            part.settings = "same";
            paths.push_back(folder_ / fmt::format("{}.exr", range.first));
            writePart(paths.back(), part);
        }
        EXPECT_EQ(mergeParts({paths[1], paths[0]}).image.pixels, expected.pixels);
    }
}

// The partial sums over a range of a frame's samples are stored by block of at most 64 samples: for each block, the
// number and the sum of its samples.
TEST_F(Partial, blocksHoldTheSumOfTheirSamples) {
    const auto small = fiveCoarseSpheres();
    FrameDriver driver = drawn(*small, LodMode::fractional, SampleRange{64, 150});
    const Image mean = driver.image();
    const FramePart part = driver.sums();
    ASSERT_EQ(part.blocks.size(), 2u);
    EXPECT_EQ(part.blocks[0].samples, 64u);
    EXPECT_EQ(part.blocks[1].samples, 22u);
    EXPECT_EQ(part.frameSamples, 150u);
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
        double sum = 0;
        for (const BlockSum& block : part.blocks)
            sum += static_cast<double>(block.sum.pixels[i]) + static_cast<double>(block.compensation.pixels[i]);
        ASSERT_NEAR(sum / 86, mean.pixels[i], 1e-6 * (1 + mean.pixels[i]));
    }
}

TEST_F(Partial, rangesAreOfWholeBlocks) {
    EXPECT_EQ(parseSampleRange("64:128").end, 128u);
    for (const char* wrong : {"", ":", "0:", "64", "64:64", "128:64", "1:64", "a:b", "-64:0", "0:99999999"})
        EXPECT_THROW(parseSampleRange(wrong), Error) << wrong;
    EXPECT_NO_THROW(checkSampleRange({64, 150}, 150));
    EXPECT_THROW(checkSampleRange({0, 100}, 150), Error);
    EXPECT_THROW(checkSampleRange({0, 192}, 150), Error);
}

}  // namespace
}  // namespace defocus::engine
