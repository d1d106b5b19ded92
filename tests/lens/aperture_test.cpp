#include "lens/aperture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "aperture_shapes.h"
#include "core/error.h"
#include "lens/lens_samples.h"

namespace defocus::engine {
namespace {

constexpr int gridSize = 700;  // cells per side of the unit square, which gives 490,000 points in total

// Returns the centres of the unit square's cells, mapped to the lens.
std::vector<glm::dvec2> mapped(const Lens& lens) {
    const Aperture aperture = makeAperture(lens);
    std::vector<glm::dvec2> points;
    for (int y = 0; y < gridSize; ++y)
        for (int x = 0; x < gridSize; ++x)
            points.push_back(apertureSample(aperture, glm::dvec2(x + 0.5, y + 0.5) / double(gridSize)));
    return points;
}

constexpr int cellCount = 24;  // number of grid cells per side of the square [−1, 1]², which contains the lens

std::size_t cellOf(const glm::dvec2& p) {
    const auto index = [](double c) { return std::clamp(static_cast<int>((c + 1) / 2 * cellCount), 0, cellCount - 1); };
    return static_cast<std::size_t>(index(p.y) * cellCount + index(p.x));
}

// Returns the fraction of the total light in each cell of the grid over the lens. `light` is evaluated at 40 × 40
// points per cell.
template <typename Light>
std::vector<double> expectedShares(const Light& light) {
    constexpr int fine = 40 * cellCount;
    std::vector<double> shares(cellCount * cellCount);
    double all = 0;
    for (int y = 0; y < fine; ++y)
        for (int x = 0; x < fine; ++x) {
            const glm::dvec2 p((x + 0.5) / fine * 2 - 1, (y + 0.5) / fine * 2 - 1);
            const double value = light(p);
            shares[cellOf(p)] += value;
            all += value;
        }
    for (double& share : shares) share /= all;
    return shares;
}

std::vector<double> sharesOf(const std::vector<glm::dvec2>& points) {
    std::vector<double> shares(cellCount * cellCount);
    for (const glm::dvec2& p : points) shares[cellOf(p)] += 1 / static_cast<double>(points.size());
    return shares;
}

// Returns the fraction of the light that lies in the wrong cell of the grid over the lens: half the sum of |a − b| over
// all cells. a and b hold the fraction of the light in each cell.
double misplaced(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]) / 2;
    return sum;
}

class ApertureOf : public testing::TestWithParam<ApertureShape> {};

TEST_P(ApertureOf, hasTheDensityOfItsDefinition) {
    const Lens lens = GetParam().lens();
    const std::vector<glm::dvec2> points = mapped(lens);
    const std::vector<double> wanted = expectedShares([&](const glm::dvec2& p) { return lightDensity(lens, p); });
    EXPECT_LT(misplaced(sharesOf(points), wanted), 0.006);
    // The bound of 0.006 is small enough to detect wrong shapes: for a slightly different aperture, more than twice
    // this fraction of the light lies in the wrong cells.
    Lens other = lens;
    other.bladeRotation += 0.1;
    other.bladeCurvature = std::abs(other.bladeCurvature - 0.3);
    other.obstruction = std::abs(other.obstruction - 0.15);
    other.sphericalAberration += other.sphericalAberration > 0 ? -0.2 : 0.2;
    EXPECT_GT(misplaced(sharesOf(mapped(other)), wanted), 0.012);
}

TEST_P(ApertureOf, liesInTheUnitDisk) {
    double farthest = 0;
    for (const glm::dvec2& p : mapped(GetParam().lens())) farthest = std::max(farthest, glm::length(p));
    EXPECT_LE(farthest, 1 + 1e-12);
    EXPECT_GT(farthest, 0.95);  // a polygon's corners lie on the rim
}

TEST_P(ApertureOf, keepsTheCentreWhereItHasOne) {
    const Lens lens = GetParam().lens();
    const double fromCentre = glm::length(apertureSample(makeAperture(lens), glm::dvec2(0.5)));
    if (lens.obstruction == 0)
        EXPECT_LT(fromCentre, 1e-12);
    else
        EXPECT_GT(fromCentre, 0.3 * lens.obstruction);
}

// The concentric map from the square to the disk, followed by its inverse, maps each point to itself, even on the
// square's diagonals and at its centre.
TEST(ConcentricDisk, isUndoneByItsInverse) {
    for (int y = 0; y <= 16; ++y)
        for (int x = 0; x <= 16; ++x) {
            const glm::dvec2 square(x / 16.0, y / 16.0);
            const glm::dvec2 back = squareOfConcentricDisk(concentricDisk(square));
            EXPECT_NEAR(back.x, square.x, 1e-12);
            EXPECT_NEAR(back.y, square.y, 1e-12);
        }
}

TEST_P(ApertureOf, isContinuous) {
    const Lens lens = GetParam().lens();
    const Aperture aperture = makeAperture(lens);
    constexpr double step = 1e-4;
    double farthest = 0;
    for (double y = 0.003; y < 1; y += 0.0137)
        for (double x = 0.002; x < 1; x += 0.0131) {
            if (lens.obstruction > 0 && glm::length(glm::dvec2(x, y) - 0.5) < 0.02) continue;
            const glm::dvec2 here = apertureSample(aperture, {x, y});
            for (const glm::dvec2& move : {glm::dvec2(step, 0), glm::dvec2(0, step)})
                farthest = std::max(farthest, glm::length(apertureSample(aperture, glm::dvec2(x, y) + move) - here));
        }
    // The square root in the map is steep at the rim of a soft disk and at the centre of a ring, hence the factor of
    // 300.
    EXPECT_LT(farthest, 300 * step);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ApertureOf, testing::ValuesIn(apertureShapes),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- aperture images

Lens lensWith(Image image) {
    return {.apertureImage = std::make_shared<const Image>(std::move(image))};
}

TEST(ApertureImage, passesLightWhereItIsBright) {
    const Image image = lopsidedImage();
    const std::vector<glm::dvec2> points = mapped(lensWith(image));
    const auto wanted = expectedShares([&](const glm::dvec2& p) { return apertureImageAt(image, p); });
    EXPECT_LT(misplaced(sharesOf(points), wanted), 0.006);
    for (const glm::dvec2& p : points) {
        ASSERT_LE(glm::length(p), 1 + 1e-12);
        if (glm::length(p) < 0.99) {
            ASSERT_GT(apertureImageAt(image, p * (1 - 1e-12)), 0) << p.x << ", " << p.y;
        }
    }
}

TEST(ApertureImage, whiteOneIsADisk) {
    for (const int size : {1, 2, 77, 1500}) {
        Image white(size, size, 3);
        std::fill(white.pixels.begin(), white.pixels.end(), 0.4f);
        const auto wanted = expectedShares([](const glm::dvec2& p) { return glm::dot(p, p) <= 1 ? 1 : 0; });
        EXPECT_LT(misplaced(sharesOf(mapped(lensWith(white))), wanted), 0.01) << size;
    }
}

TEST(ApertureImage, colourPassesByItsLuminance) {
    Image image(2, 1, 3);
    image.pixels = {1, 0, 0, 0, 1, 0};  // a red pixel, then a green one
    double right = 0;
    for (const glm::dvec2& p : mapped(lensWith(image))) right += p.x > 0 ? 1.0 / (gridSize * gridSize) : 0;
    EXPECT_NEAR(right, 0.7152 / (0.7152 + 0.2126), 0.005);
}

TEST(ApertureImage, turnsWithTheBladesAndNarrowsWithTheRatio) {
    Image image(3, 3, 1);
    *image.at(2, 1) = 1;  // a pixel to the right of the centre
    Lens lens = lensWith(image);
    lens.bladeRotation = std::numbers::pi / 2;
    lens.anamorphicRatio = 0.5;
    glm::dvec2 mean(0);
    for (const glm::dvec2& p : mapped(lens)) mean += p / double(gridSize * gridSize);
    EXPECT_NEAR(mean.x, 0, 1e-3);
    EXPECT_GT(mean.y, 0.5 / 3);
    EXPECT_LT(mean.y, 0.5);
}

TEST(ApertureImage, goodPointsStayWellSpread) {
    // With a white aperture image, the points of an even 16 × 16 grid stay evenly spread: half of them lie right of the
    // centre and half of them above it.
    Image white(64, 64, 1);
    std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
    const Aperture aperture = makeAperture(lensWith(white));
    int right = 0;
    int up = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::dvec2 p = apertureSample(aperture, glm::dvec2(x + 0.5, y + 0.5) / 16.0);
            right += p.x > 0 ? 1 : 0;
            up += p.y > 0 ? 1 : 0;
        }
    EXPECT_EQ(right, 128);
    EXPECT_EQ(up, 128);
}

TEST(ApertureImage, thoseThatPassNoLightAreNamed) {
    const auto message = [](const Image& image) -> std::string {
        try {
            static_cast<void>(makeAperture(lensWith(image)));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    Image image(8, 8, 1);
    EXPECT_NE(message(image).find("black"), std::string::npos);
    *image.at(0, 0) = 1;  // the only bright pixel lies outside the disk
    EXPECT_NE(message(image).find("black"), std::string::npos);
    *image.at(3, 5) = -1;
    EXPECT_NE(message(image).find("pixel 3,5 has the value -1"), std::string::npos);
    *image.at(3, 5) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(message(image).find("pixel 3,5 has the value nan"), std::string::npos);
    *image.at(3, 5) = std::numeric_limits<float>::infinity();
    EXPECT_NE(message(image).find("pixel 3,5 has the value inf"), std::string::npos);
    EXPECT_NE(message(Image()).find("has no pixels"), std::string::npos);
    *image.at(3, 5) = 1;
    EXPECT_EQ(message(image), "");
}

// At every lens point, the light density equals the one that aperture_shapes.h defines.
TEST(Aperture, givesTheLightDensityOfAPoint) {
    for (const ApertureShape& shape : apertureShapes) {
        const Lens lens = shape.lens();
        const Aperture aperture = makeAperture(lens);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 p = 2.0 * sequencePoint(Sequence::halton, static_cast<std::uint64_t>(i), 0).lens - 1.0;
            EXPECT_NEAR(lightDensity(aperture, p), lightDensity(lens, p), 1e-4)
                << shape.name << ' ' << p.x << ' ' << p.y;
        }
    }
}

TEST(Aperture, givesTheTransmissionOfAnImage) {
    Lens lens;
    Image image(3, 3, 1);
    for (std::size_t i = 0; i < 9; ++i) image.pixels[i] = static_cast<float>(i);
    lens.apertureImage = std::make_shared<Image>(image);
    const Aperture aperture = makeAperture(lens);
    const double centre = lightDensity(aperture, {0, 0});
    EXPECT_NEAR(lightDensity(aperture, {0.6, 0}) / centre, 5.0 / 4, 1e-4);
    EXPECT_NEAR(lightDensity(aperture, {0, 0.6}) / centre, 1.0 / 4, 1e-4);
    EXPECT_EQ(lightDensity(aperture, {0.8, 0.8}), 0);
}

}  // namespace
}  // namespace defocus::engine
