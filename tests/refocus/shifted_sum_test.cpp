// Tests the weighted mean of moved images.

#include "refocus/shifted_sum.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace defocus::engine {
namespace {

constexpr PartSize small{12, 8, 4};

// Returns an image of the full size with the values of `value(x, y)`, in px right of and above the image's centre.
template <typename Value>
Image pattern(const Value& value) {
    Image image(small.fullWidth(), small.fullHeight(), 4);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            std::fill_n(image.at(x, y), 4, static_cast<float>(value(x - image.width / 2, image.height / 2 - y)));
    return image;
}

Image shifted(const Image& image, const glm::dvec2& shift) {
    ShiftedSum sum(small);
    sum.add(image, shift);
    return sum.mean();
}

TEST(ShiftedSum, keepsThePixelsOfAnUnmovedImage) {
    const Image image = pattern([](int x, int y) { return 0.1f * static_cast<float>(x * x + 3 * y); });
    const Image mean = shifted(image, {0, 0});
    ASSERT_EQ(mean.width, small.width);
    ASSERT_EQ(mean.height, small.height);
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            EXPECT_EQ(*mean.at(x, y), *image.at(x + small.margin, y + small.margin)) << x << ' ' << y;
}

TEST(ShiftedSum, movesRightAndUp) {
    const Image image = pattern([](int x, int y) { return x == 0 && y == 0 ? 1 : 0; });
    const Image mean = shifted(image, {3, 2});
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            EXPECT_EQ(*mean.at(x, y), x == small.width / 2 + 3 && y == small.height / 2 - 2 ? 1.0f : 0.0f);
}

// Catmull–Rom splines reproduce quadratic functions.
TEST(ShiftedSum, movesAParabolaByFractions) {
    const auto value = [](double x, double y) { return 40 + 0.25 * x * x - 2 * y; };
    const Image mean = shifted(pattern(value), {0.375, -0.75});
    for (int y = 0; y < mean.height; ++y)
        for (int x = 2; x < mean.width - 2; ++x) {
            const double right = x - small.width / 2 - 0.375;
            const double up = small.height / 2 - y + 0.75;
            if (std::abs(right) < 1.5) continue;  // the clamp flattens the parabola's lowest point
            EXPECT_NEAR(*mean.at(x, y), value(right, up), 1e-4) << x << ' ' << y;
        }
}

// A highlight of 50 would ring by 50 · 2/27 = 3.7. The ring is at most that of white, once for each axis.
TEST(ShiftedSum, doesNotRingAroundHighlights) {
    const Image mean = shifted(pattern([](int x, int y) { return x == 0 && y == 0 ? 50 : 0.5; }), {0.5, 0.3});
    Image colours = mean;
    for (std::size_t i = 3; i < colours.pixels.size(); i += 4) colours.pixels[i] = 0.5f;
    EXPECT_GE(*std::ranges::min_element(colours.pixels), 0.5f - 4.0f / 27);
    EXPECT_LE(*std::ranges::max_element(colours.pixels), 50.0f + 4.0f / 27);
}

TEST(ShiftedSum, isTheWeightedMean) {
    const auto constant = [](double value) { return pattern([=](int, int) { return value; }); };
    ShiftedSum sum(small);
    for (int i = 0; i < 100; ++i) sum.add(constant(1), {0.02 * i, 0}, 0.25f);
    sum.add(constant(3), {0, 0}, 25);
    const Image mean = sum.mean();
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) EXPECT_FLOAT_EQ(mean.pixels[i], i % 4 == 3 ? 1 : 2);
}

}  // namespace
}  // namespace defocus::engine
