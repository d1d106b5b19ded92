#pragma once
// Fixture for surfaces whose blur is set by vertex attributes, with a closed form for the image of a small square.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "bokeh.h"
#include "gl_context_test.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class VertexBlurs : public GlContextTest {
protected:
    static constexpr double blurredSide = 4;  // side of the blurred square, px
    static constexpr double focus = 2;        // focus distance, m
    static constexpr int blurSamples = 256;

    // Returns a white square in the middle of a black image. All its vertices have the blur `blur`.
    static std::unique_ptr<SmallWorld> blurredSquare(double depth, const VertexBlur& blur) {
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

    static Image renderedBlur(const SmallWorld& small, const char* method = "accumulation",
                              std::uint32_t count = blurSamples) {
        const RenderSettings settings{.sampleCount = count, .lod = LodMode::off};
        return imageByMethod(method, small.world, planFrame(small.world, small.view, settings));
    }

    // Returns the number of pixels per millimetre of the sensor.
    static double perMillimetre(const SmallWorld& small) {
        return small.view.width / small.view.lens.horizontalAperture;
    }

    // Returns the variance along an axis, in px², of the blurred square's image. It is the sum of c²/16 for a blur disk
    // of diameter c, side²/12 for the square, and 1/12 for a pixel. `squared` is the mean of c² over the exposure.
    static double varianceOf(double squared) { return squared / 16 + blurredSide * blurredSide / 12 + 1.0 / 12; }

    // Variance along an axis, in px², of the unblurred square, whose edges lie on pixel borders.
    static constexpr double sharpVariance = (blurredSide * blurredSide - 1) / 12;

    // Expects the blurred image of the square to have the square's energy and centre, and the variance `expected` in
    // px². Valid for methods that sample the lens at points or lines, not for post-process methods. Method stochastic
    // gets four times as many samples, because each pixel has different sample points and errors of neighbouring pixels
    // do not cancel.
    static void expectVariance(const SmallWorld& small, double expected, const std::string& method,
                               double relative = 0.02) {
        const std::uint32_t count = method == "stochastic" ? 4 * blurSamples : blurSamples;
        const Moments moments = momentsOf(renderedBlur(small, method.c_str(), count));
        EXPECT_NEAR(moments.energy, blurredSide * blurredSide, 0.02 * blurredSide * blurredSide) << method;
        EXPECT_NEAR(moments.mean.x, small.view.width / 2.0, 0.2) << method;
        EXPECT_NEAR(moments.variance.x, expected, relative * expected) << method;
        EXPECT_NEAR(moments.variance.y, expected, relative * expected) << method;
    }

    // Returns a slanted floor of `cells` × `cells` squares. The vertex blur is `blur`(t), where t grows from 0 at the
    // near end to 1 at the far end.
    static std::unique_ptr<SmallWorld> slantedFloor(int cells, const std::function<VertexBlur(double)>& blur) {
        auto small = std::make_unique<SmallWorld>();
        small->view = bokehView(120, 90);
        small->view.lens.fStop = 0.5;
        Material white = unlitMaterial(glm::vec4(1));
        white.doubleSided = true;
        small->scene.materials.push_back(white);
        Mesh mesh;
        for (int y = 0; y <= cells; ++y)
            for (int x = 0; x <= cells; ++x) {
                const double far = double(y) / cells;
                mesh.vertices.positions.emplace_back((double(x) / cells - 0.5) * 0.4, -0.2 + 0.3 * far, -(1 + 3 * far));
                mesh.vertices.normals.emplace_back(0, 1, 0);
                mesh.vertices.blurs.push_back(blur(far));
            }
        mesh.primitives.push_back({0, gridIndices(static_cast<std::uint32_t>(cells))});
        mesh.blurBounds = boundsOf(mesh.vertices.blurs);
        small->scene.meshes.push_back(mesh);
        place(*small, 0, glm::dmat4(1));
        small->world.pyramids.push_back(fullDetail(small->scene.meshes[0]));
        small->world.environment = blackBackground();
        return small;
    }
};

}  // namespace defocus::engine
