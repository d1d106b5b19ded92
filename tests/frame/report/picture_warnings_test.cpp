#include "frame/report/picture_warnings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

// Returns an image of 100 columns: the first `left` have the value `leftValue`, the rest `rightValue`.
Image twoParts(int left, float leftValue, float rightValue) {
    Image image(100, 4, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = x < left ? leftValue : rightValue;
    return image;
}

TEST(ClippingWarnings, tellOfAPictureThatIsMostlyWhite) {
    const auto lines = clippingWarnings(twoParts(60, 1000, 0.1f), {ToneMap::none, 0});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines.front().starts_with("60 % of the image is white at an exposure of 0 EV")) << lines.front();
    EXPECT_TRUE(lines.front().ends_with("--exposure -12")) << "log2(0.18 / 1000) " << lines.front();
    EXPECT_TRUE(clippingWarnings(twoParts(60, 1000, 0.1f), {ToneMap::none, -12.0}).empty());
    EXPECT_TRUE(clippingWarnings(twoParts(40, 1000, 0.1f), {ToneMap::none, 0}).empty())
        << "a bright window is no fault";
}

TEST(ClippingWarnings, tellOfAPictureThatIsAllBlack) {
    const auto lines = clippingWarnings(twoParts(100, 1e-4f, 0), {ToneMap::none, 0});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines.front().starts_with("100 % of the image is black")) << lines.front();
    EXPECT_TRUE(lines.front().ends_with("--exposure 11")) << "log2(0.18 / 1e-4) " << lines.front();
    EXPECT_TRUE(clippingWarnings(twoParts(100, 0, 0), {ToneMap::none, 0}).empty()) << "no exposure can brighten black";
}

TEST(ClippingWarnings, colouredLightIsNotWhite) {
    Image red = twoParts(100, 0, 0);
    for (int x = 0; x < red.width; ++x)
        for (int y = 0; y < red.height; ++y) red.at(x, y)[0] = 50;
    EXPECT_TRUE(clippingWarnings(red, {ToneMap::none, 0}).empty());
}

}  // namespace
}  // namespace defocus::engine
