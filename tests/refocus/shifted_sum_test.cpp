// Tests the weighted mean of shifted images.

#include "refocus/shifted_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace defocus::engine {
namespace {

constexpr PartSize small{12, 8, 4};

// Returns an image with a margin. Each pixel has the value `value(x, y)`, where (x, y) is its position in px right of
// and above the image's centre.
template <typename Value>
HalfImage pattern(const Value& value) {
    Image image(small.fullWidth(), small.fullHeight(), 4);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            std::fill_n(image.at(x, y), 4, static_cast<float>(value(x - image.width / 2, image.height / 2 - y)));
    return halfImage(image);
}

Image moved(const HalfImage& image, const glm::ivec2& move) {
    ShiftedSum sum(small);
    sum.add(std::vector{MovedImage{&image, move, 1}});
    return sum.mean();
}

TEST(ShiftedSum, keepsThePixelsOfAnUnmovedImage) {
    const HalfImage image = pattern([](int x, int y) { return 0.1f * static_cast<float>(x * x + 3 * y); });
    const Image mean = moved(image, {0, 0});
    ASSERT_EQ(mean.width, small.width);
    ASSERT_EQ(mean.height, small.height);
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            EXPECT_EQ(*mean.at(x, y), fromHalf(*image.at(x + small.margin, y + small.margin))) << x << ' ' << y;
}

TEST(ShiftedSum, movesRightAndUp) {
    const HalfImage image = pattern([](int x, int y) { return x == 0 && y == 0 ? 1 : 0; });
    const Image mean = moved(image, {3, 2});
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            EXPECT_EQ(*mean.at(x, y), x == small.width / 2 + 3 && y == small.height / 2 - 2 ? 1.0f : 0.0f);
}

TEST(ShiftedSum, isTheWeightedMean) {
    const HalfImage one = pattern([](int, int) { return 1; });
    const HalfImage three = pattern([](int, int) { return 3; });
    ShiftedSum sum(small);
    for (int i = 0; i < 100; ++i) sum.add(std::vector{MovedImage{&one, {i % 4, -i % 3}, 0.25f}});
    sum.add(std::vector{MovedImage{&three, {0, 0}, 25}});
    const Image mean = sum.mean();
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) EXPECT_FLOAT_EQ(mean.pixels[i], 2);
}

// Images are summed in blocks of 64 images. Here, the blocks end within the second and the third call.
TEST(ShiftedSum, doesNotDependOnTheDivisionIntoCalls) {
    std::vector<HalfImage> images;
    for (int i = 0; i < 150; ++i)
        images.push_back(pattern([&](int x, int y) { return std::sin(0.7 * x + 1.3 * y + i) + 0.01 * i; }));
    std::vector<MovedImage> moved;
    for (const HalfImage& image : images) moved.push_back({&image, {static_cast<int>(moved.size()) % 5 - 2, 1}, 0.3f});
    ShiftedSum atOnce(small);
    atOnce.add(moved);
    ShiftedSum parts(small);
    for (const auto& [first, count] : {std::pair(0, 50), std::pair(50, 60), std::pair(110, 40)})
        parts.add(std::span(moved).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)));
    EXPECT_EQ(atOnce.mean().pixels, parts.mean().pixels);
}

}  // namespace
}  // namespace defocus::engine
