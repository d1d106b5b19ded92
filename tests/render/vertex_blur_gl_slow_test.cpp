// Tests blur from vertex attributes, with each method that supports it, against closed forms and finer meshes.

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "gl_conduct.h"
#include "render/vertex_blurs.h"

namespace defocus::engine {
namespace {

void openShutter(SmallWorld& small) {
    small.world.shutter.poses.assign(2, small.world.pose);
}

TEST_F(VertexBlurs, replacesTheLenss) {
    SKIP_ON_SECOND_DRIVER();
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
    SKIP_ON_SECOND_DRIVER();
    for (const double depth : {0.9, 5.0})
        for (const float millimetres : {5.0f, -5.0f}) {
            const auto small = blurredSquare(depth, {1, millimetres, millimetres});
            const double ofLens = std::copysign(blurDiameter(small->view, depth), depth - focus);
            const double diameter = ofLens + millimetres * perMillimetre(*small);
            expectVariance(*small, varianceOf(diameter * diameter), "accumulation");
            expectVariance(*small, varianceOf(diameter * diameter), "line", 0.05);
        }
}

// The blur of a vertex changes linearly between the opening and the closing of the shutter (Munkberg et al. 2012). The
// mean squared diameter is therefore (c₀² + c₀c₁ + c₁²)/3 for diameters c₀ at the opening and c₁ at the closing.
TEST_F(VertexBlurs, changesWhileTheShutterIsOpen) {
    SKIP_ON_SECOND_DRIVER();
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

double meanDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(double(a.pixels[i]) - double(b.pixels[i]));
    return sum / static_cast<double>(a.pixels.size());
}

Image floorImage(const SmallWorld& small, double tolerance, Refinement expected) {
    const RenderSettings settings{.sampleCount = 64, .lod = LodMode::off, .cocTolerance = tolerance};
    const FramePlan plan = planFrame(small.world, small.view, settings);
    EXPECT_EQ(plan.objects[0].refinement, expected);
    return imageInFloats(small.world, plan);
}

TEST_F(VertexBlurs, largeTrianglesLookLikeSmallOnes) {
    SKIP_ON_SECOND_DRIVER();
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

}  // namespace
}  // namespace defocus::engine
