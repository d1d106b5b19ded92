// Blur from vertex attributes against closed forms: a small square spreads as the disk of its blur.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bokeh.h"
#include "gl/context.h"
#include "lens/circle_of_confusion.h"
#include "render/aov/aov.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

constexpr double blurredSide = 4;  // px, side of the blurred square
constexpr double focus = 2;        // m
constexpr int blurSamples = 256;

class VertexBlurs : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<GlContext> context_;
};
std::unique_ptr<GlContext> VertexBlurs::context_;

// A white square in the middle of a black image. All its vertices have the blur `blur`.
std::unique_ptr<SmallWorld> blurredSquare(double depth, const VertexBlur& blur) {
    auto small = std::make_unique<SmallWorld>();
    small->view = bokehView(120, 90);
    small->view.lens.fStop = 1;
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    Mesh mesh = quad(0);
    mesh.vertices.blurs.assign(4, blur);
    mesh.blurBounds = boundsOf(mesh.vertices.blurs);
    small->scene.meshes.push_back(mesh);
    const double half = blurredSide / 2 * 2 * tanHalf(small->view) * depth / small->view.width;
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -depth)), glm::dvec3(half)));
    small->world.environment = blackBackground();
    finish(*small);
    return small;
}

void openShutter(SmallWorld& small) {
    small.world.shutter.poses.assign(2, small.world.pose);
}

Image renderedBlur(const SmallWorld& small, const char* method = "accumulation", std::uint32_t count = blurSamples) {
    RenderSettings settings;
    settings.sampleCount = count;
    settings.lod = LodMode::off;
    return imageByMethod(method, small.world, planFrame(small.world, small.view, settings));
}

// px per millimetre on the sensor
double perMillimetre(const SmallWorld& small) {
    return small.view.width / small.view.lens.horizontalAperture;
}

// Variance in px² of a disk whose mean squared diameter is `squared`, with the square and the pixel.
double varianceOf(double squared) {
    return squared / 16 + blurredSide * blurredSide / 12 + 1.0 / 12;
}

// Variance of the sharp square, whose edges lie between pixels.
constexpr double sharpVariance = (blurredSide * blurredSide - 1) / 12;

// Expects energy, centre and variance for methods that rasterize points or lines. Post-process methods blur with other
// kernels.
void expectVariance(const SmallWorld& small, double expected, const char* method, double relative = 0.02) {
    const Moments moments = momentsOf(renderedBlur(small, method));
    EXPECT_NEAR(moments.energy, blurredSide * blurredSide, 0.02 * blurredSide * blurredSide) << method;
    EXPECT_NEAR(moments.mean.x, small.view.width / 2.0, 0.2) << method;
    EXPECT_NEAR(moments.variance.x, expected, relative * expected) << method;
    EXPECT_NEAR(moments.variance.y, expected, relative * expected) << method;
}

TEST_F(VertexBlurs, replacesTheLenss) {
    for (const float millimetres : {6.0f, -9.0f}) {
        for (const double depth : {focus, 0.9, 5.0}) {
            const auto small = blurredSquare(depth, {0, millimetres, millimetres});
            const double diameter = millimetres * perMillimetre(*small);
            expectVariance(*small, varianceOf(diameter * diameter), "accumulation");
        }
        const auto small = blurredSquare(5, {0, millimetres, millimetres});
        const double diameter = millimetres * perMillimetre(*small);
        for (const char* method : {"multirate", "stochastic", "line", "layered"})
            expectVariance(*small, varianceOf(diameter * diameter), method, 0.05);
    }
}

TEST_F(VertexBlurs, addsToTheLenss) {
    for (const double depth : {0.9, 5.0})
        for (const float millimetres : {5.0f, -5.0f}) {
            const auto small = blurredSquare(depth, {1, millimetres, millimetres});
            const double ofLens = std::copysign(blurDiameter(small->view, depth), depth - focus);
            const double diameter = ofLens + millimetres * perMillimetre(*small);
            expectVariance(*small, varianceOf(diameter * diameter), "accumulation");
            expectVariance(*small, varianceOf(diameter * diameter), "line", 0.05);
        }
}

// Blur from vertices can cancel the blur of the lens.
TEST_F(VertexBlurs, canBringIntoFocus) {
    const auto small = blurredSquare(5, {1, 0, 0});
    const double ofLens = blurDiameter(small->view, 5) / perMillimetre(*small);
    const auto sharp = blurredSquare(5, {1, static_cast<float>(-ofLens), static_cast<float>(-ofLens)});
    expectVariance(*sharp, sharpVariance, "accumulation");
}

// C(t) is linear between the opening and the closing of the shutter (Munkberg et al. 2012), so the mean squared
// diameter is (c₀² + c₀c₁ + c₁²)/3.
TEST_F(VertexBlurs, changesWhileTheShutterIsOpen) {
    const double opening = 2, closing = -10;
    const auto small = blurredSquare(focus, {0, static_cast<float>(opening), static_cast<float>(closing)});
    const double pixels = perMillimetre(*small);
    const double still = (opening + closing) / 2 * pixels;
    for (const char* method : {"accumulation", "multirate", "stochastic", "line", "layered"})
        expectVariance(*small, varianceOf(still * still), method, 0.05);
    openShutter(*small);
    const double moving = (opening * opening + opening * closing + closing * closing) / 3 * pixels * pixels;
    for (const char* method : {"accumulation", "multirate", "stochastic"})
        expectVariance(*small, varianceOf(moving), method, 0.05);
    small->world.shutter.poses.assign(blurSamples, small->world.pose);
    small->world.shutter.perSample = true;
    expectVariance(*small, varianceOf(moving), "accumulation");
    EXPECT_THROW((void)renderedBlur(*small, "line"), Error);
}

TEST_F(VertexBlurs, keepsToLimitsAndToItsObject) {
    const auto small = blurredSquare(focus, {0, 9, 9});
    small->view.lens.backgroundLimit = 11;
    expectVariance(*small, varianceOf(11 * 11), "accumulation");
    small->view.lens.backgroundLimit = std::numeric_limits<double>::infinity();
    small->world.pose.objects[0].cocScale = 0.5;
    const double half = 4.5 * perMillimetre(*small);
    expectVariance(*small, varianceOf(half * half), "accumulation");
    small->world.pose.objects[0].cocScale = 0;
    expectVariance(*small, sharpVariance, "accumulation");
    small->world.pose.objects[0].cocScale = 1;
    small->view.lens.blurScale = 2;
    const double twice = 18 * perMillimetre(*small);
    expectVariance(*small, varianceOf(twice * twice), "accumulation");
    small->view.lens.dofEnabled = false;
    expectVariance(*small, sharpVariance, "accumulation");
}

// Post-process methods draw sharp edges without a vertex blur. With one, edges are as wide as under the same blur of
// the lens.
TEST_F(VertexBlurs, postProcessMethodsFollow) {
    for (const char* method : {"circular", "scheuermann:coc=thin-lens,max-coc=unlimited", "layered"}) {
        const auto ofLens = blurredSquare(5, {1, 0, 0});
        ofLens->view.lens.fStop = 2;
        const auto millimetres = static_cast<float>(blurDiameter(ofLens->view, 5) / perMillimetre(*ofLens));
        const auto own = blurredSquare(5, {0, millimetres, millimetres});
        own->view.lens.fStop = 2;
        const auto none = blurredSquare(5, {0, 0, 0});
        none->view.lens.fStop = 2;
        const Image expected = renderedBlur(*ofLens, method, 16);
        const Image found = renderedBlur(*own, method, 16);
        const Image sharp = renderedBlur(*none, method, 16);
        double error = 0, blur = 0;
        for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
            error = std::max(error, std::abs(double(expected.pixels[i]) - double(found.pixels[i])));
            blur = std::max(blur, std::abs(double(expected.pixels[i]) - double(sharp.pixels[i])));
        }
        EXPECT_LT(error, 2e-3) << method;
        EXPECT_GT(blur, 0.1) << method;
    }
}

// A slanted floor whose blur grows from one end to the other: two divided triangles look like many small ones.
std::unique_ptr<SmallWorld> slantedFloor(int cells, const std::function<VertexBlur(double)>& blur) {
    auto small = std::make_unique<SmallWorld>();
    small->view = bokehView(120, 90);
    small->view.lens.fStop = 0.5;
    Material white = unlitMaterial(glm::vec4(1));
    white.doubleSided = true;
    small->scene.materials.push_back(white);
    Mesh mesh;
    Primitive primitive{0, {}};
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            const double far = double(y) / cells;
            mesh.vertices.positions.emplace_back((double(x) / cells - 0.5) * 0.4, -0.2 + 0.3 * far, -(1 + 3 * far));
            mesh.vertices.normals.emplace_back(0, 1, 0);
            mesh.vertices.blurs.push_back(blur(far));
            if (x == cells || y == cells) continue;
            const auto first = static_cast<std::uint32_t>(y * (cells + 1) + x);
            const auto next = first + static_cast<std::uint32_t>(cells) + 1;
            primitive.indices.insert(primitive.indices.end(), {first, first + 1, next, first + 1, next + 1, next});
        }
    mesh.primitives.push_back(primitive);
    mesh.blurBounds = boundsOf(mesh.vertices.blurs);
    small->scene.meshes.push_back(mesh);
    place(*small, 0, glm::dmat4(1));
    small->world.pyramids.push_back(fullDetail(small->scene.meshes[0]));
    small->world.environment = blackBackground();
    return small;
}

double meanDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(double(a.pixels[i]) - double(b.pixels[i]));
    return sum / static_cast<double>(a.pixels.size());
}

Image floorImage(const SmallWorld& small, double tolerance, Refinement expected) {
    RenderSettings settings;
    settings.sampleCount = 64;
    settings.lod = LodMode::off;
    settings.cocTolerance = tolerance;
    const FramePlan plan = planFrame(small.world, small.view, settings);
    EXPECT_EQ(plan.objects[0].refinement, expected);
    return imageInFloats(small.world, plan);
}

TEST_F(VertexBlurs, largeTrianglesLookLikeSmallOnes) {
    const std::function<VertexBlur(double)> blurs[] = {
        [](double far) {
            return VertexBlur{0, static_cast<float>(12 * far), static_cast<float>(12 * far)};
        },
        [](double far) {
            return VertexBlur{static_cast<float>(1 - far), -2, -2};
        }};
    for (const auto& blur : blurs)
        for (const double limit : {std::numeric_limits<double>::infinity(), 9.0}) {
            const auto large = slantedFloor(1, blur);
            const auto fine = slantedFloor(128, blur);
            large->view.lens.backgroundLimit = fine->view.lens.backgroundLimit = limit;
            const Image reference = floorImage(*fine, 1e6, Refinement::none);
            const double error = meanDifference(floorImage(*large, 0.1, Refinement::subdivide), reference);
            EXPECT_LT(error, 2e-3);
            EXPECT_GT(meanDifference(floorImage(*large, 1e6, Refinement::none), reference), 3 * error);
        }
}

// The AOV shows the vertices' blur, interpolated over the surface.
TEST_F(VertexBlurs, aovIsTheFunctionOfThePlan) {
    const auto small = slantedFloor(1, [](double far) {
        return VertexBlur{static_cast<float>(0.5 + far), static_cast<float>(3 - 9 * far),
                          static_cast<float>(3 - 9 * far)};
    });
    const FramePlan plan = planFrame(small->world, small->view, {});
    const AovImages aovs = renderAovs(small->world, plan, {});
    int seen = 0;
    for (int y = 0; y < small->view.height; y += 3)
        for (int x = 0; x < small->view.width; x += 3) {
            const double depth = aovs.depth.at(x, y)[0];
            if (!std::isfinite(depth)) continue;
            const double far = (depth - 1) / 3;
            const double added = (3 - 9 * far) / small->view.lens.horizontalAperture;
            EXPECT_NEAR(aovs.coc.at(x, y)[0],
                        circleOfConfusion(plan.coc, depth, small->view.width, glm::dvec2(0), 0.5 + far, added), 5e-3);
            ++seen;
        }
    EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace defocus::engine
