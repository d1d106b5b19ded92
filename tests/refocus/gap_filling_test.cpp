// Tests how refocusing fills the gaps between lens images (views from points of the lens) if there are only a few of
// them.

#include "refocus/gap_filling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "refocus/shifted_sum.h"

namespace defocus::engine {
namespace {

constexpr PartSize size{64, 48, 4};

struct Sheet {
    HalfImage colour;
    Image depth;
};

// Returns a lens image (view from a point of the lens) with a margin. Its pixels have `radiance(x, y)` and
// `depth(x, y)`, where (0, 0) is the first pixel inside the margin.
Sheet layer(const std::function<float(int, int)>& radiance, const std::function<float(int, int)>& depth) {
    Image colour(size.fullWidth(), size.fullHeight(), 4);
    Sheet result{{}, Image(colour.width, colour.height, 1)};
    for (int y = 0; y < colour.height; ++y)
        for (int x = 0; x < colour.width; ++x) {
            for (int c = 0; c < 3; ++c) colour.at(x, y)[c] = radiance(x - size.margin, y - size.margin);
            colour.at(x, y)[3] = 1;
            *result.depth.at(x, y) = depth(x - size.margin, y - size.margin);
        }
    result.colour = halfImage(colour);
    return result;
}

Image filled(const std::vector<Sheet>& layers, double diameter) {
    GapFilling filling(size, {diameter, 1}, layers.size());
    for (const Sheet& each : layers) filling.add(std::vector{DeepMovedImage{&each.colour, &each.depth, {0, 0}, 1}});
    return filling.mean();
}

double sum(const Image& image) {
    double total = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) total += static_cast<double>(image.pixels[i]);
    return total;
}

// Returns the horizontal variance of an image's radiance about its mean position, in px².
double widthVariance(const Image& image) {
    double mean = 0;
    double square = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            mean += x * static_cast<double>(*image.at(x, y));
            square += x * x * static_cast<double>(*image.at(x, y));
        }
    mean /= sum(image);
    return square / sum(image) - mean * mean;
}

const auto everywhere = [](float value) { return [value](int, int) { return value; }; };
const auto point = [](int x, int y) { return x == 32 && y == 24 ? 50.0f : 0.0f; };

// Each of N lens images (views from lens points) is blurred by its lens cell, 1/N of the lens area. For a blur diameter
// of c px over the whole lens, this blur has a standard deviation of c/(2·√N) px.
TEST(GapFilling, blursAPointByItsCell) {
    for (const float depth : {0.5f, 4.0f})  // in front of and behind the focus plane at 1 m
        for (const double diameter : {4.0, 12.0, 20.0}) {
            const std::vector<Sheet> layers(4, layer(point, everywhere(depth)));
            const Image image = filled(layers, diameter);
            const double c = diameter * (1 - 1 / static_cast<double>(depth));
            EXPECT_NEAR(sum(image), 50, 0.05) << c;
            EXPECT_NEAR(widthVariance(image), c * c / 16, 0.03 * c * c / 16 + 0.03) << c;
        }
}

TEST(GapFilling, keepsWhatIsInFocus) {
    const auto stripes = [](int x, int) { return x % 2 == 0 ? 1.0f : 0.25f; };
    const Image image = filled(std::vector<Sheet>(4, layer(stripes, everywhere(1))), 20);
    for (int x = 0; x < size.width; ++x) EXPECT_FLOAT_EQ(*image.at(x, 20), stripes(x, 20)) << x;
}

TEST(GapFilling, constantScenesStayConstant) {
    const auto depths = [](int x, int y) { return x < 20 ? 0.4f : y < 30 ? 1.0f : 9.0f; };
    const Image image = filled(std::vector<Sheet>(3, layer(everywhere(0.5f), depths)), 30);
    for (const float value : image.pixels) EXPECT_TRUE(std::abs(value - 0.5f) < 1e-5f || std::abs(value - 1) < 1e-5f);
}

// The blurred background neither spreads over a sharp surface in front of it, nor receives light from this surface.
TEST(GapFilling, sharpOutlinesStaySharp) {
    const auto left = [](int x, int) { return x < 32; };
    const Image image = filled(std::vector<Sheet>(4, layer([&](int x, int y) { return left(x, y) ? 1.0f : 0.0f; },
                                                           [&](int x, int y) { return left(x, y) ? 1.0f : 8.0f; })),
                               24);
    for (int x = 0; x < size.width; ++x) EXPECT_NEAR(*image.at(x, 24), x < 32 ? 1 : 0, 1e-4) << x;
}

}  // namespace
}  // namespace defocus::engine
