#include "eval/scaling/scaling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/scaling/text.h"
#include "eval/scaling/worlds.h"
#include "plan/frame_plan.h"

namespace defocus::engine {
namespace {

using Points = std::vector<std::pair<double, double>>;

// ---- power laws -----------------------------------------------------------------------------------------------------

TEST(ScalingFit, ofAPowerIsItsExponent) {
    for (const double exponent : {-1.0, 0.0, 0.2, 1.0, 2.5}) {
        Points points;
        for (double x = 3; x < 4e7; x *= 7) points.emplace_back(x, 42 * std::pow(x, exponent));
        const std::optional<PowerLaw> law = fittedPowerLaw(points);
        ASSERT_TRUE(law);
        EXPECT_NEAR(law->exponent, exponent, 1e-12);
        EXPECT_NEAR(law->residual, 0, 1e-12);
    }
}

// The exponent is fitted to the upper half of the values on a logarithmic scale. For values from 1 to 1000, this is the
// half from √1000 on.
TEST(ScalingFit, looksAtTheUpperHalfAlone) {
    const std::optional<PowerLaw> law = fittedPowerLaw(Points{{1000, 50}, {1, 900}, {100, 5}, {10, 900}});
    ASSERT_TRUE(law);
    EXPECT_EQ(law->points, 2u);
    EXPECT_NEAR(law->exponent, 1, 1e-12);
}

// The residual of the fit is an RMS. For ln y = 0, 3, 0 at ln x = 0, 1, 2, the fit is the horizontal line at 1, with
// residuals of −1, 2 and −1.
TEST(ScalingFit, leavesTheResidualOfLeastSquares) {
    const double e = std::exp(1);
    const std::optional<PowerLaw> law =
        fittedPowerLaw(Points{{std::exp(-2.0), 1}, {1, 1}, {e, std::exp(3.0)}, {e * e, 1}});
    ASSERT_TRUE(law);
    EXPECT_EQ(law->points, 3u);
    EXPECT_NEAR(law->exponent, 0, 1e-12);
    EXPECT_NEAR(law->residual, std::sqrt(2.0), 1e-12);
}

TEST(ScalingFit, needsTwoDifferentPlaces) {
    EXPECT_FALSE(fittedPowerLaw({}));
    EXPECT_FALSE(fittedPowerLaw(Points{{5, 1}}));
    EXPECT_FALSE(fittedPowerLaw(Points{{5, 1}, {5, 2}}));
    EXPECT_FALSE(fittedPowerLaw(Points{{1, 1}, {100, 2}})) << "only one point in the upper half";
}

// ---- bottlenecks of a frame ----------------------------------------------------------------------------------------

ScalingRow rowOf(double value, double frame, double layers, double vertices) {
    ScalingRow row;
    row.value = value;
    setTimes(row, {{frame}, {layers}, {vertices}});
    return row;
}

using Parts = std::vector<ScalingPart>;

TEST(ScalingParts, theRestIsFill) {
    EXPECT_EQ(rowOf(1, 10, 2, 3).fill.median, 5);
    EXPECT_EQ(rowOf(1, 10, 2, 3).largestParts(), Parts{ScalingPart::fill});
    EXPECT_EQ(rowOf(1, 10, 6, 3).largestParts(), Parts{ScalingPart::layers});
    EXPECT_EQ(rowOf(1, 10, 1, 8).largestParts(), Parts{ScalingPart::vertices});
    EXPECT_EQ(rowOf(1, 10, 4, 8).fill.median, 0) << "overlapping parts leave no time for fill";
}

// `fill` is the frame time minus the times of layers and of vertices. The spread of `fill` is computed from its values
// in the three runs: 5, 7 and 6 ms.
TEST(ScalingParts, spreadAsTheirRunsDo) {
    ScalingRow row;
    setTimes(row, {{10, 20, 15}, {2, 6, 4}, {3, 7, 5}});
    EXPECT_EQ(row.runs, 3);
    EXPECT_EQ(row.fill.median, 6);
    EXPECT_DOUBLE_EQ(row.fill.low, 5.2);
    EXPECT_DOUBLE_EQ(row.fill.high, 6.8);
    EXPECT_EQ(row.layers.median, 4);
}

TEST(ScalingParts, areAlikeWhereNoneIsLargerBeyondDoubt) {
    // A single run gives no estimate of the noise, so times that differ by less than 5 % of the frame time count as
    // equal. Of 60 ms, vertices take 23.5 ms and fill takes 24.1 ms.
    EXPECT_EQ(rowOf(1, 60, 12.4, 23.5).largestParts(), (Parts{ScalingPart::vertices, ScalingPart::fill}));
    EXPECT_EQ(rowOf(1, 60, 12.4, 21).largestParts(), Parts{ScalingPart::fill});
    EXPECT_EQ(rowOf(1, 60, 20, 20).largestParts(),
              (Parts{ScalingPart::layers, ScalingPart::vertices, ScalingPart::fill}));

    // `fill` takes about 40 ms of the frame time and `layers` 30 ms. In the first measurement, `fill` is larger in all
    // runs; in the second, the ranges of the two overlap.
    ScalingRow row;
    setTimes(row, {{72, 71, 73}, {30, 29, 31}, {2, 2, 2}});
    EXPECT_EQ(row.largestParts(), Parts{ScalingPart::fill});
    setTimes(row, {{72, 72, 72}, {30, 40, 20}, {2, 2, 2}});
    EXPECT_EQ(row.largestParts(), (Parts{ScalingPart::layers, ScalingPart::fill}));
}

TEST(ScalingText, whatIsLeftOutIsNamedAsInTheTable) {
    ScalingPoint point;
    point.value = 5e7;
    EXPECT_EQ(scalingLine(ScalingLeftOut{point, "too large"}), "triangles 50 M is left out: too large\n");
}

TEST(ScalingParts, areNamedWhereTheyChange) {
    const ScalingRow fill = rowOf(100'000, 10, 1, 1);
    const ScalingRow vertices = rowOf(1'000'000, 10, 1, 8);
    ScalingRow more = vertices;
    more.value = 3e6;
    ScalingRow layers = rowOf(1e7, 10, 8, 1);
    EXPECT_EQ(boundsAlong(std::vector{fill}), "fill throughout");
    EXPECT_EQ(boundsAlong(std::vector{fill, vertices}), "fill up to 100 k, vertex work from 1 M");
    EXPECT_EQ(boundsAlong(std::vector{fill, vertices, layers}),
              "fill up to 100 k, vertex work at 1 M, adding layers from 10 M");
    const ScalingRow both = rowOf(300'000, 10, 1, 4.5);
    EXPECT_EQ(boundsAlong(std::vector{fill, both, vertices}),
              "fill up to 100 k, vertex work and fill alike at 300 k, vertex work from 1 M");
    EXPECT_NE(scalingCsv(std::vector{both}).find(",vertex work and fill alike,"), std::string::npos);
    EXPECT_EQ(boundsAlong(std::vector{fill, vertices, more, layers}),
              "fill up to 100 k, vertex work from 1 M to 3 M, adding layers from 10 M");
}

TEST(ScalingFiles, csvJsonAndSummaryHoldEveryCurve) {
    std::vector<ScalingRow> rows;
    for (const LodMode mode : {LodMode::off, LodMode::fractional})
        for (const double triangles : {1e5, 1e6, 1e7}) {
            rows.push_back(rowOf(triangles, mode == LodMode::off ? triangles / 1e4 : 20, 1, 2));
            rows.back().mode = mode;
        }
    const std::string csv = scalingCsv(rows);
    ASSERT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 7 * commas);

    const ScalingLeftOut leftOut{scalingPoints(ScalingAxis::triangles, true).back(), "no memory"};
    const auto json = nlohmann::json::parse(scalingJson(rows, std::vector{leftOut}, {}, {}));
    EXPECT_EQ(json["rows"].size(), 6u);
    ASSERT_EQ(json["curves"].size(), 2u);
    EXPECT_NEAR(json["curves"][0]["time"]["exponent"].get<double>(), 1, 1e-9);
    EXPECT_NEAR(json["curves"][1]["time"]["exponent"].get<double>(), 0, 1e-9);
    EXPECT_EQ(json["leftOut"][0]["value"], 50e6);
    EXPECT_TRUE(json["curves"][0]["gpuMemory"].is_null()) << "no GPU memory was measured";
    EXPECT_NE(scalingSummary(rows).find("exponent  1.00"), std::string::npos) << scalingSummary(rows);
}

// ---- measured points and their scenes -------------------------------------------------------------------------------

TEST(ScalingPoints, changeOnlyWhatTheirAxisNames) {
    for (const ScalingAxis axis : ScalingOptions().axes) {
        const std::vector<ScalingPoint> points = scalingPoints(axis, false);
        ASSERT_GE(points.size(), 4u);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const ScalingPoint& p = points[i];
            const ScalingPoint defaults;
            EXPECT_EQ(p.axis, axis);
            EXPECT_TRUE(p.triangles == defaults.triangles || axis == ScalingAxis::triangles);
            EXPECT_TRUE(p.instances == defaults.instances || axis == ScalingAxis::instances);
            EXPECT_TRUE(p.samples == defaults.samples || axis == ScalingAxis::samples);
            EXPECT_TRUE(p.width == defaults.width || axis == ScalingAxis::pixels);
            EXPECT_TRUE(!p.fStop || axis == ScalingAxis::blur);
            if (i > 0 && axis != ScalingAxis::blur) {
                EXPECT_GT(p.value, points[i - 1].value);
            }
        }
    }
    EXPECT_EQ(scalingPoints(ScalingAxis::triangles, false).back().value, 1e7);
    EXPECT_EQ(scalingPoints(ScalingAxis::triangles, true).back().value, 5e7);
}

TEST(ScalingWorlds, aSchoolHasAboutTheTrianglesAskedFor) {
    for (const std::uint64_t triangles : {20'000ull, 60'000ull}) {
        const ScalingWorld school = schoolOf(triangles, {});
        std::uint64_t total = 0;
        for (const Pyramid& pyramid : school.world.pyramids.all()) total += pyramid.levels[0].triangleCount;
        EXPECT_NEAR(static_cast<double>(total) / static_cast<double>(triangles), 1, 0.15);
        EXPECT_EQ(school.world.pose.objects.size(), 8u);
    }
}

// Grids of any number of instances fill the same view. Every instance lies completely within the view and fills its
// cell of the grid; the layers of the grid lie at depths from 2 to 6 m.
TEST(ScalingWorlds, aGridFillsTheSameView) {
    for (const int instances : {1, 8, 100, 1000}) {
        const ScalingWorld grid = gridOf(instances, 300, {});
        ASSERT_EQ(grid.world.pose.objects.size(), static_cast<std::size_t>(instances));
        const int side = static_cast<int>(std::ceil(std::cbrt(instances) - 1e-9));
        const glm::dmat4 viewFromWorld = glm::inverse(grid.view.worldFromCamera);
        const double tanX = tanHalfHorizontalFov(grid.view.lens);
        const Bounds& box = grid.world.pyramids[0].bounds;
        for (const Object& object : grid.world.pose.objects) {
            const glm::dvec3 middle(viewFromWorld * object.worldFromObject * glm::dvec4(box.centre(), 1));
            EXPECT_LE(std::abs(middle.x), -middle.z * tanX);
            EXPECT_LE(std::abs(middle.y), -middle.z * tanX * 0.75);
            EXPECT_GE(-middle.z, 2);
            EXPECT_LE(-middle.z, 6);
            const Bounds placed = transformed(box, viewFromWorld * object.worldFromObject);
            const double longest = std::max({placed.size().x, placed.size().y, placed.size().z});
            EXPECT_LE(longest, 2 * 0.8 * tanX * 0.75 * -middle.z / side * 1.8)
                << "an instance must not exceed its cell";
        }
    }
}

}  // namespace
}  // namespace defocus::engine
