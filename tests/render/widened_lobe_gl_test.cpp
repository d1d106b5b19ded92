// Tests of highlights that are widened by the variation of normals within a pixel.

#include <glm/gtc/matrix_transform.hpp>

#include "render/shadowed.h"

namespace defocus::engine {
namespace {

// Returns an image of a metal ball under a sun, through a pinhole. The ball's diameter is about 0.7 of the image's
// width.
Image metalBall(bool smooth, const glm::dvec3& toLight, int width, const auto& draw) {
    SmallWorld small;
    Material metal;
    metal.roughnessFactor = 0.3f;
    small.scene.materials.push_back(metal);
    small.scene.meshes.push_back(bumpySphere(128, 96, 0));
    Vertices& vertices = small.scene.meshes.back().vertices;
    vertices.colors.clear();
    if (smooth) {
        for (glm::vec3& position : vertices.positions) position = glm::normalize(position);
        vertices.normals = vertices.positions;
    }
    place(small, 0, glm::translate(glm::dmat4(1), {0, 0, -4}));
    PlacedLight sun;
    sun.light.intensity = 1;
    sun.direction = -glm::normalize(toLight);
    small.world.lights.push_back(sun);
    small.world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    small.view.width = small.view.height = width;
    small.view.lens.dofEnabled = false;
    small.world.pyramids = {fullDetail(small.scene.meshes[0])};
    return draw(small);
}

class WidenedLobe : public Shadowed {
protected:
    static Image ball(bool smooth, const glm::dvec3& toLight, int width, std::uint32_t samples) {
        return metalBall(smooth, toLight, width, [&](const SmallWorld& small) {
            return shadowImage(small, settingsFor(samples, Shadows::off));
        });
    }

    static double meanGreen(const Image& image) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y)[1]);
        return sum / (static_cast<double>(image.width) * image.height);
    }
};

// The sun is behind the ball, 140° from the camera. The ripples tilt the normals by at most 25°, and the sphere's
// normals within 2 px of the middle are within 24° of the camera. They all face away from the sun.
TEST_F(WidenedLobe, rippledFacesThatFaceAwayStayBlack) {
    const Image image = ball(false, {0.8, 0.3, -1}, 16, 1);
    double lit = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            lit += static_cast<double>(image.at(x, y)[1]);
            if (std::hypot(x - 7.5, y - 7.5) < 2) {
                EXPECT_EQ(image.at(x, y)[1], 0) << x << ", " << y;
            }
        }
    EXPECT_GT(lit, 0);
}

// A ball of 20 px reflects as much light as one of 300 px, whose pixels are too small to widen the highlight.
TEST_F(WidenedLobe, smallBallsAreAsBrightAsLargeOnes) {
    for (const glm::dvec3& toLight : {glm::dvec3(0.3, 0.4, 1), glm::dvec3(1, 0.3, -0.1), glm::dvec3(0.8, 0.3, -1)}) {
        const double truth = meanGreen(ball(true, toLight, 400, 1));
        EXPECT_NEAR(meanGreen(ball(true, toLight, 28, 16)) / truth, 1, 0.08) << toLight.x;
    }
}

}  // namespace
}  // namespace defocus::engine
