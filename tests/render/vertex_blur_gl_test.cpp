// Tests blur from vertex attributes against closed forms: a small square becomes a disk of the diameter of its blur.

#include <cmath>

#include "lens/circle_of_confusion.h"
#include "render/aov/aov.h"
#include "render/vertex_blurs.h"

namespace defocus::engine {
namespace {

// A blur added by a vertex attribute can cancel the lens's blur: with the negative CoC added, the square is sharp.
TEST_F(VertexBlurs, canBringIntoFocus) {
    const auto small = blurredSquare(5, {1, 0, 0});
    const double ofLens = blurDiameter(small->view, 5) / perMillimetre(*small);
    const auto sharp = blurredSquare(5, {1, static_cast<float>(-ofLens), static_cast<float>(-ofLens)});
    expectVariance(*sharp, sharpVariance, "accumulation");
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

// The radial example of Munkberg et al. 2012 multiplies the circle of confusion a + b·w of a thin lens by 1 + x² + y²
// at the clip position (x, y, w) in m. The test draws a square away from the image's centre.
TEST_F(VertexBlurs, drawTheRadialExampleAsPrinted) {
    constexpr double depth = 5;
    const glm::dvec2 position(0.8, -0.5);  // m
    const View view = bokehView(120, 90);
    const glm::dvec2 tangents = tanHalf(view) * glm::dvec2(1, double(view.height) / view.width);
    const double factor = 1 + glm::dot(position / tangents, position / tangents);
    const auto small = blurredSquare(depth, {static_cast<float>(factor), 0, 0});
    glm::dmat4& placed = small->world.pose.objects[0].worldFromObject;
    placed = glm::translate(glm::dmat4(1), glm::dvec3(position, 0)) * placed;
    small->view.lens.fStop = 8;
    const double diameter = factor * blurDiameter(small->view, depth);
    ASSERT_GT(factor, 3);
    const Moments moments = momentsOf(renderedBlur(*small, "stochastic:coc-interpolation=linear", 4 * blurSamples));
    const double expected = varianceOf(diameter * diameter);
    EXPECT_NEAR(moments.variance.x, expected, 0.03 * expected);
    EXPECT_NEAR(moments.variance.y, expected, 0.03 * expected);
}

// Post-process methods draw vertex blur like an equal blur of the lens. A vertex blur of zero gives sharp edges.
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

// The CoC AOV shows the vertices' blur, interpolated over the surface.
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
