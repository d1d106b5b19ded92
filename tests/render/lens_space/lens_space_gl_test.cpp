// Properties of both lens-space methods; the accumulation is the reference.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bokeh.h"
#include "core/error.h"
#include "gl/context.h"
#include "image/metrics.h"
#include "likeness.h"
#include "posed_world.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

RenderSettings raySettings(std::uint32_t samples) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = LodMode::off;
    settings.keepAll = true;  // samples the lens even where nothing is blurred
    return settings;
}

Image lensSpaceImage(const char* method, const SmallWorld& small, std::uint32_t samples, RenderStats* stats = nullptr,
                     std::uint32_t wave = 0) {
    const MethodUse use = parseMethodUse(method);
    RendererOptions options;
    options.settings = use.settings;
    options.wave = wave;
    const auto renderer = use.method->make(small.world, options);
    Image image = imageOf(*renderer, planFrame(small.world, small.view, raySettings(samples)));
    if (stats != nullptr) *stats = renderer->stats();
    return image;
}

// Returns a number of rays that suffices for the tests' error bounds. A line is worth several points.
std::uint32_t enoughFor(const std::string& method) {
    return method == "line" ? 40 : 256;
}

double psnrAgainst(const Image& reference, const Image& image) {
    return compareImages(reference, image, CompareOptions{}).psnr;
}

double figureOf(const RenderStats& stats, const std::string& name) {
    for (const MethodFigure& figure : stats.figures)
        if (figure.name == name) return figure.value;
    return std::nan("");
}

// Two lit, rippled spheres, in front of and behind the focus, before a gradient sky.
std::unique_ptr<SmallWorld> twoSpheres(int slices = 24, int stacks = 18) {
    auto small = std::make_unique<SmallWorld>();
    Material glossy;
    glossy.metallicFactor = 0;
    glossy.roughnessFactor = 0.4f;
    small->scene.materials.push_back(glossy);
    small->scene.meshes.push_back(bumpySphere(slices, stacks, 0));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {-0.2, -0.1, -1.4}), glm::dvec3(0.2)));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0.6, 0.4, -5}), glm::dvec3(-0.9, 0.9, 0.9)));
    PlacedLight sun;
    sun.light.intensity = 2;
    sun.direction = glm::normalize(glm::dvec3(-0.3, -1, -0.6));
    small->world.lights.push_back(sun);
    small->world.environment = {
        EnvironmentType::gradient, {0.6f, 0.8f, 1.0f}, {0.4f, 0.5f, 0.6f}, {0.1f, 0.1f, 0.2f}, nullptr, 1};
    small->view.lens.fStop = 1;
    small->view.lens.focusDistance = 2.2;
    small->view.width = 72;
    small->view.height = 56;
    finish(*small);
    return small;
}

// A ground from behind the camera to far away, cut by the near plane.
std::unique_ptr<SmallWorld> groundUnderCamera() {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh = quad(0);
    mesh.vertices.colors = {{1, 0.2f, 0.1f, 1}, {0.1f, 1, 0.2f, 1}, {0.2f, 0.1f, 1, 1}, {1, 1, 0.2f, 1}};
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    place(*small, 0,
          glm::rotate(glm::scale(glm::translate(glm::dmat4(1), {0.1, -0.3, 0}), glm::dvec3(4)), -0.5 * std::numbers::pi,
                      glm::dvec3(1, 0, 0)));
    small->world.environment = {EnvironmentType::uniform, {0.3f, 0.4f, 0.9f}, {}, {}, nullptr, 1};
    small->view.width = 64;
    small->view.height = 48;
    small->view.lens.fStop = 0.5;
    small->view.lens.focusDistance = 1.5;
    finish(*small);
    return small;
}

void expectRefusal(const char* method, const SmallWorld& small, const std::string& part) {
    try {
        lensSpaceImage(method, small, 4);
        FAIL() << method << " took it";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

class LensSpace : public testing::TestWithParam<const char*> {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    void TearDown() override { EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}); }
    static inline std::unique_ptr<GlContext> context_;
};

TEST_P(LensSpace, convergesToTheAccumulation) {
    const auto small = twoSpheres();
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *small, enoughFor(GetParam()))), 40);
}

TEST_P(LensSpace, withoutAnApertureIsThePinholeImage) {
    const auto small = twoSpheres();
    small->view.lens.dofEnabled = false;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *small, enoughFor(GetParam()))), 44);
}

TEST_P(LensSpace, showsAConstantSceneAsConstant) {
    const auto small = twoSpheres();
    small->scene.materials[0] = unlitMaterial({0.5f, 0.25f, 1, 1});
    for (auto& pyramid : small->world.pyramids)
        for (auto& level : pyramid.levels) level.colors.assign(level.colors.size(), glm::vec4(1));
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
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *small, enoughFor(GetParam()))), 40);
}

// Shading at vertices equals shading at surfaces where colours are linear over a triangle, and nearly equals it on
// small lit triangles.
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
    EXPECT_LT(coarse, 60);  // the two shadings do differ
}

TEST_P(LensSpace, hasTheShapeOfTheAperture) {
    const auto small = twoSpheres();
    small->view.lens.bladeCount = 5;
    small->view.lens.bladeRotation = 0.3;
    small->view.lens.bladeCurvature = 0.2;
    small->view.lens.anamorphicRatio = 1.5;
    small->view.lens.obstruction = 0.4;
    small->view.lens.sphericalAberration = 0.6;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *small, enoughFor(GetParam()))), 50);
}

// A grid of side² squares of two triangles each, over 6 x 6 px within one tile.
std::unique_ptr<SmallWorld> gridInATile(std::uint32_t side) {
    auto small = std::make_unique<SmallWorld>();
    Mesh mesh;
    mesh.name = "grid";
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x)
            mesh.vertices.positions.emplace_back(static_cast<float>(x) / side, static_cast<float>(y) / side, 0);
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 0, 1});
    Primitive primitive{0, {}};
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t i = y * (side + 1) + x;
            for (const std::uint32_t v : {i, i + 1, i + side + 2, i, i + side + 2, i + side + 1})
                primitive.indices.push_back(v);
        }
    mesh.primitives.push_back(primitive);
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(mesh);
    small->view.width = small->view.height = 32;
    small->view.lens.dofEnabled = false;
    const double pixel = 2 * tanHalfHorizontalFov(small->view.lens) * 2 / 32;  // m per pixel at a depth of 2 m
    // The grid covers pixels 17 to 23 from the left and from below, inside the tiles of 8 and of 16 px that begin at
    // 16.
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {pixel, pixel, -2}), glm::dvec3(6 * pixel)));
    small->world.environment.type = EnvironmentType::none;  // alpha is coverage
    small->world.pyramids.push_back(fullDetail(small->scene.meshes[0]));
    return small;
}

// Expects every ray through the grid to meet a triangle, wherever that triangle lies in the tile's list. A lost
// triangle leaves a hole.
void expectWholeGrid(const Image& image) {
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const bool inside = x >= 17 && x < 23 && y >= 9 && y < 15;
            ASSERT_EQ(image.at(x, y)[3], inside ? 1.0f : 0.0f) << x << " " << y;
        }
}

// A grid side with more triangles than Mesa's software driver allows rounds of a loop, 65,536.
constexpr std::uint32_t longerThanLoops = 184;

TEST_P(LensSpace, losesNoneOfTensOfThousandsOfTrianglesInATile) {
    constexpr std::uint32_t side = longerThanLoops;
    const auto small = gridInATile(side);
    RenderStats stats;
    const Image image = lensSpaceImage(GetParam(), *small, 4, &stats);
    EXPECT_EQ(figureOf(stats, "triangles in the fullest tile"), 2 * side * side);
    EXPECT_EQ(figureOf(stats, "triangles in all tiles"), 2 * side * side);
    expectWholeGrid(image);
}

// Blurred triangles, hundreds of them on each line, form the same white square as two large triangles.
TEST_P(LensSpace, seesTensOfThousandsOfBlurredTrianglesInATileAsTheirSquare) {
    const auto blurred = [](std::uint32_t side) {
        auto small = gridInATile(side);
        small->view.lens.dofEnabled = true;
        small->view.lens.focusDistance = 2.5;
        small->view.lens.fStop = 0.6;
        return small;
    };
    const bool lines = std::string(GetParam()) == "line";
    const auto square = blurred(1);
    const Image reference = imageInFloats(square->world, planFrame(square->world, square->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *blurred(longerThanLoops), lines ? 24 : 64)), 40);
}

TEST_P(LensSpace, meetsEachOfThousandsOfTrianglesInATile) {
    const std::uint32_t side = 100;
    const auto small = gridInATile(side);
    RenderStats stats;
    const Image image = lensSpaceImage(GetParam(), *small, 4, &stats);
    EXPECT_EQ(figureOf(stats, "triangles in the fullest tile"), 2 * side * side);
    EXPECT_EQ(figureOf(stats, "triangles in all tiles"), 2 * side * side);
    expectWholeGrid(image);
}

TEST_P(LensSpace, refusesByName) {
    const auto blended = twoSpheres();
    blended->scene.materials[0].alphaMode = AlphaMode::blend;
    blended->scene.materials[0].name = "Glass";
    expectRefusal(GetParam(), *blended, "object 'Object 0' has the alpha-blended material 'Glass'");
    const auto masked = twoSpheres();
    masked->scene.materials[0].alphaMode = AlphaMode::mask;
    expectRefusal(GetParam(), *masked, "alpha-tested");
    const auto coloured = twoSpheres();
    coloured->view.lens.axialChromaticAberration = 0.5;
    expectRefusal(GetParam(), *coloured, "axial chromatic aberration");
    const auto barrel = twoSpheres();
    barrel->view.lens.catEye = 0.5;
    expectRefusal(GetParam(), *barrel, "cat's eye");
    const auto range = groundUnderCamera();
    range->view.lens.focusRangeFront = 0.5;
    range->view.lens.focusRangeBehind = 3;
    expectRefusal(GetParam(), *range, "controls of the blur");
}

INSTANTIATE_TEST_SUITE_P(Methods, LensSpace, testing::Values("stochastic", "line"));

using Models = LensSpace;

// Textures, normal maps and skins look as in the accumulation.
TEST_P(Models, lookAsInTheAccumulation) {
    const auto small = posedWorld(modelPath("Fox.glb"), 0.3, 0);
    small->view.lens.fStop = 1.4;
    small->view.lens.blurScale = 400;
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage(GetParam(), *small, enoughFor(GetParam()))), 40);
}
INSTANTIATE_TEST_SUITE_P(Methods, Models, testing::Values("stochastic", "line"));

class LensSpaceAlone : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static inline std::unique_ptr<GlContext> context_;
};

TEST_F(LensSpaceAlone, stochasticPointsBlurMotion) {
    const auto small = twoSpheres();
    small->world.shutter.poses.assign(3, small->world.pose);
    for (int i = 0; i < 3; ++i)
        small->world.shutter.poses[static_cast<std::size_t>(i)].objects[0].worldFromObject =
            glm::scale(glm::translate(glm::dmat4(1), {-0.35 + 0.15 * i, -0.1, -1.4 + 0.1 * i * i}), glm::dvec3(0.2));
    const Image reference = imageInFloats(small->world, planFrame(small->world, small->view, raySettings(1024)));
    EXPECT_GE(psnrAgainst(reference, lensSpaceImage("stochastic", *small, 256)), 50);
    expectRefusal("line", *small, "motion blur is not supported");
    small->world.shutter.perSample = true;
    small->world.shutter.poses.push_back(small->world.shutter.poses.back());  // one pose for each of four samples
    expectRefusal("stochastic", *small, "motion segments");
}

// Two distant triangles that do not intersect fit into any buffer, so both kinds of lines give the same image.
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
    EXPECT_EQ(figureOf(stats, "merged segments per line"), 0);
    EXPECT_LT(largestDifference(exact, buffered), 2e-3);
}

// Segments that do not fit a buffer of two are counted, and more segments reduce the error.
TEST_F(LensSpaceAlone, fullBuffersCountWhatTheyDrop) {
    const auto small = twoSpheres();
    RenderStats stats;
    const Image exact = lensSpaceImage("line", *small, 16);
    const Image few = lensSpaceImage("line:resolve=published,segments=2", *small, 16, &stats);
    EXPECT_GT(figureOf(stats, "dropped share of the light") + figureOf(stats, "merged segments per line"), 0.01);
    const Image many = lensSpaceImage("line:resolve=published,segments=16", *small, 16);
    EXPECT_GT(psnrAgainst(exact, many), psnrAgainst(exact, few));
}

// Returns the root mean square error of squares of `side` px. Averaging suppresses noise and keeps structure.
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

// A bright spot far out of focus: few lines at the same angles in every pixel show as spokes, and rotated lines turn
// them into noise.
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
    // The noise is no larger than the structure it replaces. Less than half of it remains after averaging 8 x 8 px.
    EXPECT_LT(errorOfSquares(reference, turned, 1), 1.05 * errorOfSquares(reference, shared, 1));
    EXPECT_LT(errorOfSquares(reference, turned, 8), 0.5 * errorOfSquares(reference, shared, 8));
}

// Two quads intersect. The buffer shows a single quad between its ends, and exact lines show both.
TEST_F(LensSpaceAlone, exactLinesFindIntersections) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials = {unlitMaterial({1, 0, 0, 1}), unlitMaterial({0, 0, 1, 1})};
    small->scene.meshes = {quad(0), quad(1)};
    for (const double turn : {-0.6, 0.6})
        place(*small, turn < 0 ? 0 : 1,
              glm::rotate(glm::translate(glm::dmat4(1), {0.03, 0, -2}), turn, glm::dvec3(0, 1, 0)));
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
