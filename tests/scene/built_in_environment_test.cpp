// Compares the built-in environment maps with known integrals and symmetries.

#include "scene/built_in_environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace defocus::engine {
namespace {

class BuiltInEnvironment : public testing::TestWithParam<std::string_view> {
protected:
    const Image map = builtInEnvironment(std::string(GetParam()));
};

// Under each map, a horizontal white surface has a radiance of 1: ∫ L cos θ dω over the upper hemisphere is π. The
// integral of cos θ sin θ over a row of the map is half the difference of sin² θ at the row's edges.
TEST_P(BuiltInEnvironment, lightsALevelWhiteSurfaceToWhite) {
    double illuminance = 0;
    for (int y = 0; y < map.height / 2; ++y) {
        const double top = std::sin(std::numbers::pi * y / map.height);
        const double bottom = std::sin(std::numbers::pi * (y + 1) / map.height);
        const double area = (bottom * bottom - top * top) * std::numbers::pi / map.width;
        for (int x = 0; x < map.width; ++x) {
            const float* pixel = map.at(x, y);
            illuminance += (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]) * area;
        }
    }
    EXPECT_NEAR(illuminance, std::numbers::pi, 0.01);
    for (const float value : map.pixels) ASSERT_TRUE(std::isfinite(value) && value > 0);
}

// The map has no seam behind the camera: its first and last columns differ no more than other adjacent columns.
TEST_P(BuiltInEnvironment, hasNoSeam) {
    const auto step = [&](int a, int b) {
        double sum = 0;
        for (int y = 0; y < map.height; ++y) sum += std::abs(map.at(a, y)[1] - map.at(b, y)[1]);
        return sum;
    };
    double largest = 0;
    for (int x = 0; x + 1 < map.width; ++x) largest = std::max(largest, step(x, x + 1));
    EXPECT_LE(step(map.width - 1, 0), largest);
}

TEST_P(BuiltInEnvironment, turnsByWholeColumnsAndBack) {
    const Image quarter = turnedEnvironment(map, std::numbers::pi / 2);
    // A quarter turn moves the centre column from direction −z to −x: a quarter of the map's width to the left.
    for (int y = 0; y < map.height; y += 17)
        EXPECT_EQ(quarter.at(map.width / 4, y)[0], map.at(map.width / 2, y)[0]) << y;
    EXPECT_EQ(turnedEnvironment(quarter, -std::numbers::pi / 2).pixels, map.pixels);
    EXPECT_EQ(turnedEnvironment(map, 0).pixels, map.pixels);

    // Rotation by a fraction of a column preserves the sum of all texels.
    const Image between = turnedEnvironment(map, 0.3 * 2 * std::numbers::pi / map.width);
    double before = 0;
    double after = 0;
    for (const float value : map.pixels) before += value;
    for (const float value : between.pixels) after += value;
    EXPECT_NEAR(after, before, 1e-4 * before);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInEnvironment, testing::Values("studio", "overcast", "sunset"),
                         [](const auto& tested) { return std::string(tested.param); });

// The overcast sky follows the CIE formula L(h) = Lz (1 + 2 sin h) / 3, with elevation h and zenith luminance Lz.
TEST(BuiltInEnvironments, anOvercastSkyIsThatOfTheCie) {
    const Image map = builtInEnvironment("overcast");
    const int row = 100;
    const double elevation = std::numbers::pi * (0.5 - (row + 0.5) / map.height);
    EXPECT_NEAR(map.at(100, row)[1] / map.at(100, 0)[1], (1 + 2 * std::sin(elevation)) / 3, 1e-3);
    EXPECT_NEAR(map.at(100, 50)[1], map.at(300, 50)[1], 1e-6);
}

TEST(BuiltInEnvironments, areKnownByName) {
    for (const std::string_view name : builtInEnvironments()) EXPECT_TRUE(isBuiltInEnvironment(std::string(name)));
    EXPECT_FALSE(isBuiltInEnvironment("studio.hdr"));
    EXPECT_FALSE(isBuiltInEnvironment(""));
}

}  // namespace
}  // namespace defocus::engine
