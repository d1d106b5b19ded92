#pragma once
// Fixture for images of a far ball of white metal, whose reflected light is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "gl_conduct.h"
#include "gl_context_test.h"
#include "render/methods.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class Mirror : public GlContextTest {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }

    // distance in m, so large that all light towards the camera has almost the same direction
    static constexpr double ballDepth = 200;
    static constexpr double ballRadius = 1;
    static constexpr double ballFocalLength = 2000;  // mm

    // Returns a ball of white metal without bumps, about 36 px across in an image of 64 × 48 px.
    static std::unique_ptr<SmallWorld> mirrorBall(float roughness) {
        auto small = std::make_unique<SmallWorld>();
        const Material metal{.roughnessFactor = roughness};
        small->scene.materials.push_back(metal);
        Mesh ball = bumpySphere(128, 64, 0);
        for (std::size_t v = 0; v < ball.vertices.count(); ++v) {
            ball.vertices.positions[v] = glm::normalize(ball.vertices.positions[v]);
            ball.vertices.normals[v] = ball.vertices.positions[v];
        }
        ball.vertices.colors.clear();
        small->scene.meshes.push_back(std::move(ball));
        place(*small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -ballDepth)));
        small->world.environment.type = EnvironmentType::none;
        small->view.width = 64;
        small->view.height = 48;
        small->view.lens.focalLength = ballFocalLength;
        small->view.lens.dofEnabled = false;
        finish(*small);
        return small;
    }

    static Image ballImage(const SmallWorld& small, const RenderSettings& settings) {
        return imageInFloats(small.world, planFrame(small.world, small.view, settings));
    }

    // Returns the integral of the image's red channel over the solid angle, which is the intensity towards the camera.
    static double intensityOf(const Image& image) {
        const double pixel = 36.0 / ballFocalLength / image.width;  // pixel size on the image plane at distance 1
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double right = (x + 0.5 - 0.5 * image.width) * pixel;
                const double up = (y + 0.5 - 0.5 * image.height) * pixel;
                sum += static_cast<double>(image.at(x, y)[0]) * pixel * pixel *
                       std::pow(1 + right * right + up * up, -1.5);
            }
        return sum;
    }

    static RenderSettings ballSettings(std::uint32_t samples, std::uint32_t seed) {
        return {.sampleCount = samples, .seed = seed, .lod = LodMode::off};
    }
};

}  // namespace defocus::engine
