#include "image/quantise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

Image evenly(float value, int channels = 3) {
    Image image(64, 64, channels);
    for (float& each : image.pixels) each = value;
    return image;
}

double meanOf(const std::vector<std::uint8_t>& bytes) {
    double sum = 0;
    for (const std::uint8_t byte : bytes) sum += byte;
    return sum / static_cast<double>(bytes.size());
}

TEST(Quantised, aBytesOwnValueStays) {
    for (int byte = 0; byte < 256; ++byte)
        for (const std::uint8_t each : quantised(evenly(static_cast<float>(byte) / 255.0f))) ASSERT_EQ(each, byte);
}

TEST(Quantised, theMeanIsTheValueAndNoneIsAWholeStepAway) {
    for (const double value : {0.1, 10.5, 99.25, 127.9, 254.6}) {
        const std::vector<std::uint8_t> bytes = quantised(evenly(static_cast<float>(value / 255)));
        EXPECT_NEAR(meanOf(bytes), value, 0.02) << value;
        for (const std::uint8_t byte : bytes) ASSERT_LT(std::abs(byte - value), 1) << value;
    }
}

// Squares of 4 × 4 px also keep their mean; otherwise, clumps of dither noise would be visible.
TEST(Quantised, smallSquaresHaveTheirMeanToo) {
    const std::vector<std::uint8_t> bytes = quantised(evenly(100.5f / 255, 1));
    for (std::size_t y = 0; y + 4 <= 64; y += 4)
        for (std::size_t x = 0; x + 4 <= 64; x += 4) {
            double sum = 0;
            for (std::size_t i = 0; i < 16; ++i) sum += bytes[(y + i / 4) * 64 + x + i % 4];
            EXPECT_NEAR(sum / 16, 100.5, 0.2);
        }
}

TEST(Quantised, coverageIsRounded) {
    for (const std::uint8_t byte : quantised(evenly(100.6f / 255, 4))) EXPECT_TRUE(byte == 100 || byte == 101);
    const std::vector<std::uint8_t> bytes = quantised(evenly(100.6f / 255, 4));
    for (std::size_t i = 3; i < bytes.size(); i += 4) ASSERT_EQ(bytes[i], 101);
}

}  // namespace
}  // namespace defocus::engine
