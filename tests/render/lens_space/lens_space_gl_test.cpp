// Tests properties of both lens-space methods, with method "accumulation" as the reference.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl_conduct.h"
#include "likeness.h"
#include "posed_world.h"
#include "render/lens_space/lens_space_images.h"

namespace defocus::engine {
namespace {

// Returns a number of rays (points or lines on the lens) with which `method` meets the tests' error bounds. A lens line
// replaces several lens points.
std::uint32_t enoughFor(const std::string& method) {
    return method == "line" ? 40 : 256;
}

// Expects a PSNR of at least `minPsnr` dB against method "accumulation" with 1,024 samples.
void expectAccumulation(const SmallWorld& small, const char* method, double minPsnr) {
    const Image reference = imageInFloats(small.world, planFrame(small.world, small.view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(method, small, enoughFor(method))), minPsnr);
}

TEST_P(LensSpace, convergesToTheAccumulation) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = twoSpheres();
    expectAccumulation(*small, GetParam(), 40);
}

TEST_P(LensSpace, withoutAnApertureIsThePinholeImage) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = twoSpheres();
    small->view.lens.dofEnabled = false;
    expectAccumulation(*small, GetParam(), 44);
}

TEST_P(LensSpace, showsAConstantSceneAsConstant) {
    const auto small = twoSpheres();
    small->scene.materials[0] = unlitMaterial({0.5f, 0.25f, 1, 1});
    changePyramids(small->world, [](Pyramid& pyramid) {
        for (auto& level : pyramid.levels) level.colors.assign(level.colors.size(), glm::vec4(1));
    });
    small->world.environment = {EnvironmentType::uniform, {0.5f, 0.25f, 1}, {}, {}, nullptr, 1};
    const Image image = lensSpaceImage(GetParam(), *small, 7);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_NEAR(image.pixels[i], i % 4 == 0 ? 0.5f : i % 4 == 1 ? 0.25f : 1.0f, 2e-5f);
}

TEST_P(LensSpace, drawsTheSameWhateverTheWave) {
    const auto small = twoSpheres();
    const Image full = lensSpaceImage(GetParam(), *small, 12);
    EXPECT_TRUE(sameBits(lensSpaceImage(GetParam(), *small, 12, nullptr, 5), full));
    EXPECT_TRUE(sameBits(lensSpaceImage(GetParam(), *small, 12), full));
}

TEST_P(LensSpace, drawsWhatPassesTheCamera) {
    const auto small = groundUnderCamera();
    expectAccumulation(*small, GetParam(), 40);
}

// Shading at vertices and shading at each visible surface point give the same image if colours are linear over each
// triangle. On small lit triangles, they are nearly equal.
TEST_P(LensSpace, shadesVerticesOrSurfaces) {
    const std::string method = GetParam();
    const auto ground = groundUnderCamera();
    const Image surfaces = lensSpaceImage(GetParam(), *ground, 8);
    EXPECT_LT(largestDifference(surfaces, lensSpaceImage((method + ":shading=vertices").c_str(), *ground, 8)), 1e-3);
    const auto psnr = [&](int slices) {
        const auto spheres = twoSpheres(slices, slices * 3 / 4);
        return psnrAgainst(lensSpaceImage(GetParam(), *spheres, 8),
                           lensSpaceImage((method + ":shading=vertices").c_str(), *spheres, 8));
    };
    const double coarse = psnr(24);
    const double fine = psnr(96);
    EXPECT_GE(fine, 40);
    EXPECT_GT(fine, coarse + 6);
    EXPECT_LT(coarse, 60);  // on large triangles, the two differ visibly: PSNR < 60 dB
}

TEST_P(LensSpace, hasTheShapeOfTheAperture) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = twoSpheres();
    small->view.lens.bladeCount = 5;
    small->view.lens.bladeRotation = 0.3;
    small->view.lens.bladeCurvature = 0.2;
    small->view.lens.anamorphicRatio = 1.5;
    small->view.lens.obstruction = 0.4;
    small->view.lens.sphericalAberration = 0.6;
    expectAccumulation(*small, GetParam(), 50);
}

// Expects all pixels of the grid to be covered. If any triangle in the list of its tile were skipped, the grid would
// have a hole.
void expectWholeGrid(const Image& image) {
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const bool inside = x >= 17 && x < 23 && y >= 9 && y < 15;
            ASSERT_EQ(image.at(x, y)[3], inside ? 1.0f : 0.0f) << x << " " << y;
        }
}

TEST_P(LensSpace, meetsEachOfManyTrianglesInATile) {
    for (const std::uint32_t side : {100u, longerThanLoops}) {
        RenderStats stats;
        const Image image = lensSpaceImage(GetParam(), *gridInATile(side), 4, &stats);
        EXPECT_EQ(figureOf(stats, "triangles in the fullest tile"), 2 * side * side);
        EXPECT_EQ(figureOf(stats, "triangles in all tiles"), 2 * side * side);
        ASSERT_NO_FATAL_FAILURE(expectWholeGrid(image)) << side;
    }
}

TEST_P(LensSpace, refusesByName) {
    const auto coloured = twoSpheres();
    coloured->view.lens.axialChromaticAberration = 0.5;
    expectRefusal(GetParam(), *coloured, "axial chromatic aberration");
    const auto barrel = twoSpheres();
    barrel->view.lens.catEye = 0.5;
    expectRefusal(GetParam(), *barrel, "cat's-eye bokeh");
}

INSTANTIATE_TEST_SUITE_P(Methods, LensSpace, testing::Values("stochastic", "line"));

using Models = LensSpace;

// Models with textures, normal maps and skins look the same as with method "accumulation".
TEST_P(Models, lookAsInTheAccumulation) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = posedWorld(modelPath("Fox.glb"), 0.3, 0);
    small->view.lens.fStop = 1.4;
    small->view.lens.blurScale = 400;
    expectAccumulation(*small, GetParam(), 40);
}
INSTANTIATE_TEST_SUITE_P(Methods, Models, testing::Values("stochastic", "line"));

// Visibility along lens lines (lines across the lens) is exact by default. With resolve=published, it uses the
// fixed-size segment buffers of Tzeng et al. 2012. If no segment is dropped, both give the same image. Two separate
// quads that do not intersect fit into any buffer.
TEST_F(LensSpaceAlone, exactLinesAreTheBuffersWhereNothingWasDropped) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({1, 0.5f, 0.2f, 1}), unlitMaterial({0.1f, 0.4f, 0.9f, 1})};
    small->scene.meshes = {quad(0), quad(1)};
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {-0.3, 0, -1.5}), glm::dvec3(0.4)));
    place(*small, 1, glm::scale(glm::translate(glm::dmat4(1), {0.5, 0.2, -4}), glm::dvec3(1)));
    small->world.environment = {EnvironmentType::uniform, {0.3f, 0.3f, 0.3f}, {}, {}, nullptr, 1};
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.fStop = 0.8;
    finish(*small);
    RenderStats stats;
    const Image exact = lensSpaceImage("line", *small, 16, &stats);
    EXPECT_EQ(figureOf(stats, "dropped segments per line"), 0);
    const Image buffered = lensSpaceImage("line:resolve=published", *small, 16, &stats);
    EXPECT_LT(figureOf(stats, "dropped share of the light"), 1e-4);
    EXPECT_GT(figureOf(stats, "merged segments per line"), 0);  // segments of a quad's two triangles merge
    EXPECT_LT(largestDifference(exact, buffered), 2e-3);
}

// A buffer of two segments per lens line counts the segments that it drops or merges. With larger buffers, the image is
// closer to the one with exact visibility.
TEST_F(LensSpaceAlone, fullBuffersCountWhatTheyDrop) {
    const auto small = twoSpheres();
    RenderStats stats;
    const Image exact = lensSpaceImage("line", *small, 16);
    const Image few = lensSpaceImage("line:resolve=published,segments=2", *small, 16, &stats);
    EXPECT_GT(figureOf(stats, "dropped share of the light") + figureOf(stats, "merged segments per line"), 0.01);
    const Image many = lensSpaceImage("line:resolve=published,segments=16", *small, 16);
    EXPECT_GT(psnrAgainst(exact, many), psnrAgainst(exact, few));
}

// Returns the RMS difference between the images' means over squares of `side` × `side` px. The means suppress noise and
// keep structure.
double errorOfSquares(const Image& reference, const Image& image, int side) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y + side <= image.height; y += side)
        for (int x = 0; x + side <= image.width; x += side) {
            double error = 0;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i)
                    error += static_cast<double>(image.at(x + i, y + j)[1] - reference.at(x + i, y + j)[1]);
            sum += error * error / std::pow(side, 4);
            ++count;
        }
    return std::sqrt(sum / count);
}

// If a few lens lines (lines across the lens) have the same angles in every pixel, they are visible as spokes in the
// bokeh of a bright spot. Rotating the lines from pixel to pixel turns the spokes into noise.
TEST_F(LensSpaceAlone, turnedWheelsMakeNoiseOfStrobes) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({30, 30, 30, 1})};
    small->scene.meshes = {quad(0)};
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -6}), glm::dvec3(0.1)));
    small->world.environment = {EnvironmentType::uniform, {0.01f, 0.01f, 0.01f}, {}, {}, nullptr, 1};
    small->view.width = small->view.height = 96;
    small->view.lens.fStop = 0.1;
    small->view.lens.focusDistance = 1;
    finish(*small);
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(4096)));
    const Image shared = lensSpaceImage("line:wheel=shared", *small, 8);
    const Image turned = lensSpaceImage("line", *small, 8);
    // In single pixels, the noise of turned lines has at most about the error of the spokes of shared lines. Averaged
    // over 8 × 8 px, its error is less than half as large.
    EXPECT_LT(errorOfSquares(reference, turned, 1), 1.05 * errorOfSquares(reference, shared, 1));
    EXPECT_LT(errorOfSquares(reference, turned, 8), 0.5 * errorOfSquares(reference, shared, 8));
}

// Two quads intersect. Along a lens line (line across the lens), exact visibility switches from one quad to the other
// where they intersect. The segment buffers of Tzeng et al. 2012 switch only at the ends of segments. One of the quads
// is double-sided and seen from behind.
TEST_F(LensSpaceAlone, exactLinesFindIntersections) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({1, 0, 0, 1}), unlitMaterial({0, 0, 1, 1})};
    small->scene.meshes = {quad(0), quad(1)};
    small->scene.materials[1].doubleSided = true;
    for (const int i : {0, 1}) {
        const double turn = i == 0 ? -0.6 : 0.6 - std::numbers::pi;
        place(*small, i, glm::rotate(glm::translate(glm::dmat4(1), {0.03, 0, -2}), turn, glm::dvec3(0, 1, 0)));
    }
    small->world.environment = {EnvironmentType::uniform, {0.3f, 0.3f, 0.3f}, {}, {}, nullptr, 1};
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.fStop = 0.5;
    small->view.lens.focusDistance = 1;
    finish(*small);
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    const double exact = psnrAgainst(reference, lensSpaceImage("line", *small, 64));
    EXPECT_GE(exact, 40);
    EXPECT_GT(exact, psnrAgainst(reference, lensSpaceImage("line:resolve=published", *small, 64)) + 3);
}

}  // namespace
}  // namespace defocus::engine
