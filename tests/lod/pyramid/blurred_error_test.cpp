// Compares a level's error under blur with values derived from a known change to the level.

#include "lod/pyramid/blurred_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "lod/pyramid/level_selection.h"
#include "lod/shapes.h"

namespace defocus::engine {
namespace {

// Returns a pyramid whose level 0 is a coloured ball of radius 1. Level 1 is a copy of level 0 modified by `change`.
Pyramid withLevel(const std::function<glm::vec4(const glm::vec3&)>& colour,
                  const std::function<void(PyramidLevel&)>& change, std::size_t helpers = 0) {
    Mesh mesh = sphere(96, 48);
    for (const glm::vec3& p : mesh.vertices.positions) mesh.vertices.colors.push_back(colour(p));
    Pyramid pyramid = fullDetail(mesh);
    for (glm::vec3& normal : pyramid.levels[0].normals) normal = glm::normalize(normal);
    pyramid.levels.push_back(pyramid.levels[0]);
    change(pyramid.levels[1]);
    measureBlurredErrors(pyramid, {}, helpers);
    return pyramid;
}

glm::vec4 striped(const glm::vec3& p) {
    return {0.5f + 0.4f * std::sin(9 * p.x), 0.3f + 0.2f * p.z, 0.6f, 1};
}

void brighten(PyramidLevel& level, float factor) {
    for (glm::vec4& colour : level.colors) colour *= factor;
}

double sideOf(const Pyramid& pyramid, int number) {
    return pyramid.smallestPatch * std::exp2(number);
}

// Under blur, errors are averaged over square image patches as wide as the blur. If a level is 1 + ε times as bright as
// level 0, its error in a patch is ε times the patch's mean radiance. The contrast is the standard deviation of the
// radiance around this mean; it is the error if one lens sample stands for the patch. The squared mean and the squared
// standard deviation add up to the mean squared radiance, which does not depend on the patch size.
TEST(BlurredError, aBrighterLevelAndTheSamplesShareTheLight) {
    constexpr double more = 0.125;
    const Pyramid pyramid = withLevel(striped, [](PyramidLevel& level) { brighten(level, 1 + more); });
    const double all = squaredError(pyramid, 1, 0) / (more * more);
    EXPECT_GT(all, 1) << "no mean square is below the square of the mean";
    EXPECT_EQ(squaredContrast(pyramid, 0), 0);
    for (int i = 0; i < 7; ++i) {
        const double side = sideOf(pyramid, i);
        EXPECT_NEAR(squaredError(pyramid, 1, side) / (more * more) + squaredContrast(pyramid, side), all, 1e-3 * all)
            << "side " << side;
    }
    // The ball covers at most 38 % of a patch as wide as the diagonal of its bounding box, 2√3. The rest of the patch
    // is background, so the contrast is high.
    EXPECT_GT(squaredContrast(pyramid, 2 * std::sqrt(3)), 0.6);
}

TEST(BlurredError, halfTheErrorIsHalfTheTable) {
    const Pyramid full = withLevel(striped, [](PyramidLevel& level) { brighten(level, 1.25f); });
    const Pyramid half = withLevel(striped, [](PyramidLevel& level) { brighten(level, 1.125f); });
    for (const double side : {0.0, 0.01, 0.1, 0.7, 3.0, 40.0})
        EXPECT_NEAR(squaredError(full, 1, side) / squaredError(half, 1, side), 4, 1e-3) << "side " << side;
}

// A blur hides a lost pattern but not a colour offset. Averaging over patches that are five half-periods wide hides
// most of the error of a sine pattern; the error of a constant offset remains.
TEST(BlurredError, aBlurHidesAPatternButNoShift) {
    const auto wave = [](const glm::vec3& p) { return 0.2f * std::sin(31.4f * p.x) * std::sin(31.4f * p.z); };
    const auto grey = [](const glm::vec3&) { return glm::vec4(0.5f, 0.5f, 0.5f, 1); };
    const Pyramid pattern = withLevel(grey, [&](PyramidLevel& level) {
        for (std::size_t v = 0; v < level.colors.size(); ++v) level.colors[v] += wave(level.positions[v]);
    });
    const Pyramid shift = withLevel(grey, [](PyramidLevel& level) {
        for (glm::vec4& colour : level.colors) colour += 0.1f;
    });
    const auto left = [](const Pyramid& pyramid, double side) {
        return std::sqrt(squaredError(pyramid, 1, side) / squaredError(pyramid, 1, 0));
    };
    EXPECT_LT(left(pattern, 0.5), 0.2);
    EXPECT_GT(left(pattern, 0.02), 0.8);
    EXPECT_GT(left(shift, 0.5), 0.75);
}

// Returns a flat, unlit, white pyramid of two levels. Level 0 consists of the triangles `both` and `lost`, level 1 only
// of `both`.
Pyramid flatWithout(const std::vector<glm::vec3>& both, const std::vector<glm::vec3>& lost) {
    Mesh mesh;
    mesh.vertices.positions = both;
    mesh.vertices.positions.insert(mesh.vertices.positions.end(), lost.begin(), lost.end());
    mesh.primitives.emplace_back();
    for (std::uint32_t v = 0; v < mesh.vertices.count(); ++v) mesh.primitives[0].indices.push_back(v);
    Pyramid pyramid = fullDetail(mesh);
    PyramidLevel level = pyramid.levels[0];
    const auto isLost = [&](std::uint32_t v) { return std::ranges::count(lost, level.positions[v]) > 0; };
    level.primitives[0] = {static_cast<std::uint32_t>(pyramid.indices.size()), 0};
    for (std::size_t i = 0; i < 3 * std::size_t{level.triangleCount}; i += 3) {
        const std::array corners{pyramid.indices[i], pyramid.indices[i + 1], pyramid.indices[i + 2]};
        if (std::ranges::all_of(corners, isLost)) continue;
        pyramid.indices.insert(pyramid.indices.end(), corners.begin(), corners.end());
        level.primitives[0].count += 3;
    }
    level.triangleCount = level.primitives[0].count / 3;
    pyramid.levels.push_back(level);
    measureBlurredErrors(pyramid, std::array{Finish{.unlit = true}});
    return pyramid;
}

std::vector<glm::vec3> rectangle(const glm::vec2& low, const glm::vec2& high) {
    const glm::vec3 a(low, 0), b(high.x, low.y, 0), c(high, 0), d(low.x, high.y, 0);
    return {a, b, c, a, c, d};
}

// The full mesh is a plate beside strips of width w and length l; the level lacks the strips. Without blur, the squared
// error is the fraction of the area that the strips cover. Under blur, errors are averaged over square patches of side
// s > w. A patch on a strip averages the strip's radiance with black, so its error is w/s. The patches along a strip
// have the area l · s, so the sum of their squared errors is (w/s)² · l · s. Foreshortening in each view direction
// changes w and l. The strips count although they are thinner than a pixel of the images from which errors are
// measured.
TEST(BlurredError, lostWiresCountByTheirWidthUnderThePixel) {
    constexpr double width = 0.004, plate = 0.5;
    constexpr int count = 12;
    std::vector<glm::vec3> wires;
    std::vector<glm::dvec3> ways;
    for (int i = 0; i < count; ++i) {
        const double low = plate + 0.06 * (i + 1), high = low + 0.01 * i;
        const glm::vec3 a(low, 0, 0), b(low + width, 0, 0), c(high + width, 1, 0), d(high, 1, 0);
        wires.insert(wires.end(), {a, b, c, a, c, d});
        ways.emplace_back(high - low, 1, 0);
    }
    const Pyramid pyramid = flatWithout(rectangle({0, 0}, {plate, 1}), wires);
    EXPECT_LT(width, pyramid.smallestPatch / 2);
    double covered = 0, points = 0, lines = 0;
    for (const glm::dvec3& towards : blurredErrorViews()) {
        covered += (plate + count * width) * std::abs(towards.z);
        for (const glm::dvec3& way : ways) {
            const double length = glm::length(way - glm::dot(way, towards) * towards);
            const double area = width * std::abs(towards.z);
            points += area;
            lines += area * area / length;
        }
    }
    EXPECT_NEAR(squaredError(pyramid, 1, 0) * covered / points, 1, 0.1);
    for (int i = 0; i < 2; ++i) {  // only the two smallest patch sizes, since larger patches contain two wires
        const double side = sideOf(pyramid, i);
        const double truth = lines / (side * covered);
        EXPECT_GT(squaredError(pyramid, 1, side), 0.5 * truth) << "side " << side;
        EXPECT_LT(squaredError(pyramid, 1, side), 2 * truth) << "side " << side;
    }
}

// If a disk of 60 corners becomes a hexagon, the squared error is the fraction of the disk's area that is lost.
TEST(BlurredError, aCoarseOutlineCountsByItsArea) {
    std::vector<glm::vec3> hexagon, rest;
    const auto corner = [](int i) {
        const double turn = 2 * std::numbers::pi * i / 60;
        return glm::vec3(std::cos(turn), std::sin(turn), 0);
    };
    for (int i = 0; i < 60; i += 10) {
        hexagon.insert(hexagon.end(), {glm::vec3(0), corner(i), corner(i + 10)});
        for (int k = 1; k < 10; ++k) rest.insert(rest.end(), {corner(i), corner(i + k), corner(i + k + 1)});
    }
    const Pyramid pyramid = flatWithout(hexagon, rest);
    const double full = 30 * std::sin(2 * std::numbers::pi / 60);
    EXPECT_NEAR(squaredError(pyramid, 1, 0), (full - 3 * std::sin(std::numbers::pi / 3)) / full, 0.01);
}

// A plate of uniform radiance has no contrast against a background that is as bright as the plate. Against black, its
// outline has contrast.
TEST(BlurredError, greyHidesAnEvenPlate) {
    const Pyramid pyramid = flatWithout(rectangle({0, 0}, {1, 1}), rectangle({1, 0}, {1.1, 1}));
    for (const double side : {0.05, 0.5}) {
        EXPECT_GT(squaredContrast(pyramid, side), 0.04);
        EXPECT_LT(squaredContrast(pyramid, side, Surround::grey), 1e-4);
        EXPECT_LT(squaredError(pyramid, 1, side, Surround::grey), 1e-4);
    }
}

// Shrinking a ball of radius 1 by ε removes a rim of area 2πε, and the mean squared error is proportional to that area.
TEST(BlurredError, anOutlineCountsByTheAreaThatItLoses) {
    const auto white = [](const glm::vec3&) { return glm::vec4(1); };
    const auto shrunk = [&](float factor) {
        return squaredError(withLevel(white,
                                      [&](PyramidLevel& level) {
                                          for (glm::vec3& p : level.positions) p *= factor;
                                      }),
                            1, 0);
    };
    const double lost = shrunk(0.96f);
    EXPECT_NEAR(lost / shrunk(0.98f), 2, 0.3);
    // The removed rim has 2 · 0.04 of the ball's projected area. Its radiance and the mean radiance lie between 0.2 and
    // 1, so the relative squared error in the rim lies between 0.2² and 5².
    EXPECT_GT(lost, 0.2 * 0.2 * 2 * 0.04);
    EXPECT_LT(lost, 5 * 5 * 2 * 0.04);
}

TEST(BlurredError, normalsCountByTheLight) {
    const auto white = [](const glm::vec3&) { return glm::vec4(1); };
    const auto turned = [&](float angle) {
        return withLevel(white, [&](PyramidLevel& level) {
            for (glm::vec3& n : level.normals)
                n = {std::cos(angle) * n.x - std::sin(angle) * n.y, std::sin(angle) * n.x + std::cos(angle) * n.y, n.z};
        });
    };
    EXPECT_LT(squaredError(turned(0), 1, 0.1), 1e-8);
    EXPECT_NEAR(squaredError(turned(0.1f), 1, 0) / squaredError(turned(0.05f), 1, 0), 4, 0.4);
}

// Averaged over square patches far larger than the mesh, the error E is inversely proportional to the side of a patch,
// like the error of a single point of light. Patches with ten times the side have a hundredth of E².
TEST(BlurredError, fallsAsASpotBeyondTheMesh) {
    const Pyramid pyramid = withLevel(striped, [](PyramidLevel& level) { brighten(level, 1.25f); });
    EXPECT_NEAR(squaredError(pyramid, 1, 100) / squaredError(pyramid, 1, 1000), 100, 1e-6);
}

TEST(BlurredError, theSameWithAnyNumberOfThreads) {
    const auto brighter = [](PyramidLevel& level) { brighten(level, 1.25f); };
    const Pyramid one = withLevel(striped, brighter, 0);
    const Pyramid four = withLevel(striped, brighter, 3);
    EXPECT_EQ(one.smallestPatch, four.smallestPatch);
    EXPECT_EQ(one.contrast, four.contrast);
    EXPECT_EQ(one.levels[1].blurredError, four.levels[1].blurredError);
}

TEST(BlurredError, ofWhatHasNoLightOrNoSecondLevelIsNothing) {
    const auto black = [](const glm::vec3&) { return glm::vec4(0, 0, 0, 1); };
    const Pyramid dark = withLevel(black, [](PyramidLevel&) {});
    EXPECT_EQ(squaredError(dark, 1, 0.1), 0);
    EXPECT_EQ(levelOfBlurredError(dark, std::array{0.1}, 100, 0.5), 0);
    const Pyramid single = fullDetail(sphere(12, 6));
    EXPECT_EQ(levelOfBlurredError(single, std::array{0.1}, 100, 0.5), 0);
    EXPECT_EQ(levelOfBlurredError(Pyramid{}, std::array{0.1}, 100, 0.5), 0);
}

// At the selected fractional level λ, the ratio of error to contrast equals its limit. The contrast is the standard
// deviation of level 0's radiance within the blur. Ratios and limits are interpolated linearly between levels. λ is
// clamped to the range from 0 to the coarsest level.
TEST(BlurredError, theLevelMeetsItsLimit) {
    const Pyramid pyramid = buildPyramid(sphere(96, 48, 0.05));
    ASSERT_GT(pyramid.levels.size(), 4u);
    const std::array sides{0.05, 0.4};
    const auto mean = [&](const auto& squared) { return std::sqrt(squared(sides[0]) + squared(sides[1])); };
    // Returns the ratio of error to contrast of level l, on the background (black or grey) with the larger ratio.
    const auto error = [&](std::size_t l) {
        double worst = 0;
        for (const Surround surround : surrounds)
            worst = std::max(worst, mean([&](double side) { return squaredError(pyramid, l, side, surround); }) /
                                        mean([&](double side) { return squaredContrast(pyramid, side, surround); }));
        return worst;
    };
    const auto last = static_cast<double>(pyramid.levels.size() - 1);
    std::set<std::size_t> met;
    for (const double pixelsPerUnit : {20.0, 200.0, 2000.0})
        for (double light = 1e-4; light < 1e3; light *= 1.5) {
            const double lambda = levelOfBlurredError(pyramid, sides, pixelsPerUnit, light);
            const auto fine = std::min(static_cast<std::size_t>(lambda), pyramid.levels.size() - 2);
            const auto at = [&](const auto& ofLevel) {
                return std::lerp(ofLevel(fine), ofLevel(fine + 1), lambda - static_cast<double>(fine));
            };
            const double limit =
                at([&](std::size_t l) { return measuredLimit(light, pyramid.levels[l].meanEdge * pixelsPerUnit); });
            if (lambda == last)
                EXPECT_LE(at(error), limit);
            else
                EXPECT_NEAR(at(error), limit, 1e-9 * limit) << pixelsPerUnit << ' ' << light;
            met.insert(fine);
        }
    EXPECT_EQ(met.size(), pyramid.levels.size() - 1) << "the sweep goes through all levels";
    EXPECT_EQ(levelOfBlurredError(pyramid, sides, 100, 1e9), last);
    EXPECT_EQ(levelOfBlurredError(pyramid, sides, 100, 0), 0);
}

// A level's error limit is inversely proportional to its edge length, but at most 0.3 times the error that is expected
// from the number of lens samples.
TEST(BlurredError, theLimitFollowsEdgesAndSamples) {
    for (const std::uint32_t samples : {16u, 64u, 1024u}) {
        const double light = defaultThresholds(LodMetric::measured, samples).light;
        EXPECT_NEAR(measuredLimit(light, 20), 0.5 * measuredLimit(light, 10), 1e-12) << samples;
        EXPECT_NEAR(measuredLimit(light, 1e-3), 0.3 * expectedSampleError(samples), 1e-12) << samples;
    }
}

// The selected fractional level λ has no jumps as the blur grows. λ follows from the ratio E/V of error to contrast.
// Errors grow by a factor of at least 1.1 per level, so λ changes by at most 1/(1 − 1/1.1) = 11 times the relative
// change of E/V. E² changes at most with the fourth power of the blur width, and V² at most with the second. If the
// blur widens by 1/1000, E/V thus changes by at most (4 + 2)/2 thousandths of its value.
TEST(BlurredError, theLevelIsContinuousInTheBlur) {
    Mesh mesh = sphere(64, 32, 0.05);
    for (const glm::vec3& p : mesh.vertices.positions) mesh.vertices.colors.push_back(striped(p));
    const Pyramid pyramid = buildPyramid(mesh);
    constexpr double pixelsPerUnit = 100, light = 0.3;
    constexpr double step = 1.001;
    constexpr double max = 11 * (4 + 2) / 2 * (step - 1) * 1.05;
    double last = levelOfBlurredError(pyramid, std::array{1e-3, 2e-3}, pixelsPerUnit, light);
    double coarsest = last;
    for (double side = 1e-3; side < 50; side *= step) {
        const double level = levelOfBlurredError(pyramid, std::array{side, 2 * side}, pixelsPerUnit, light);
        ASSERT_LE(std::abs(level - last), max) << "at " << side;
        last = level;
        coarsest = std::max(coarsest, level);
    }
    EXPECT_GT(coarsest, 2) << "the sweep goes through levels";
}

TEST(BlurredError, theThresholdFollowsTheSamples) {
    const auto light = [](std::uint32_t samples) { return defaultThresholds(LodMetric::measured, samples).light; };
    EXPECT_GT(light(16), light(64));
    EXPECT_LT(light(1024) / expectedSampleError(1024), 0.8 * light(16) / expectedSampleError(16));
    EXPECT_EQ(expectedSampleError(1), 1);
}

}  // namespace
}  // namespace defocus::engine
