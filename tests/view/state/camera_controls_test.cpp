#include "view/state/camera_controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "near.h"

namespace defocus::engine {
namespace {

constexpr double pi = std::numbers::pi;

void expectRigid(const ViewCamera& camera) {
    const glm::dmat3 axes(camera.worldFromCamera);
    const glm::dmat3 product = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1 : 0, 1e-12);
    EXPECT_NEAR(glm::determinant(axes), 1, 1e-12);
}

ViewCamera example() {
    const glm::dmat4 view = glm::lookAt(glm::dvec3(3, 2, 5), glm::dvec3(0.5, 1, 0), glm::dvec3(0, 1, 0));
    return {glm::inverse(view), glm::length(glm::dvec3(2.5, 1, 5))};
}

TEST(CameraControls, orbitKeepsPivotAndDistance) {
    ViewCamera camera = example();
    const glm::dvec3 pivot = camera.pivot();
    for (int i = 0; i < 500; ++i) camera = orbited(camera, 0.05, 0.013 * (i % 7 - 3));
    expectNear(camera.pivot(), pivot, 1e-9);
    EXPECT_NEAR(glm::length(camera.position() - pivot), example().pivotDistance, 1e-9);
    expectRigid(camera);
    EXPECT_NEAR(camera.worldFromCamera[0].y, 0, 1e-9);  // the horizon stays horizontal
}

TEST(CameraControls, aWholeOrbitEndsWhereItBegan) {
    ViewCamera camera = example();
    for (int i = 0; i < 36; ++i) camera = orbited(camera, pi / 18, 0);
    expectNear(camera.position(), example().position(), 1e-9);
    expectNear(camera.forward(), example().forward(), 1e-9);
}

TEST(CameraControls, neverTipsOver) {
    ViewCamera up = example();
    ViewCamera down = example();
    for (int i = 0; i < 100; ++i) {
        up = orbited(up, 0, 0.2);
        down = orbited(down, 0, -0.2);
    }
    EXPECT_GT(up.forward().y, 0.999);
    EXPECT_LT(down.forward().y, -0.999);
    for (const ViewCamera& camera : {up, down}) {
        EXPECT_GT(camera.worldFromCamera[1].y, 0);
        expectRigid(camera);
        expectNear(camera.pivot(), example().pivot(), 1e-9);
    }
}

TEST(CameraControls, aRollIsKept) {
    ViewCamera rolled = example();
    rolled.worldFromCamera = rolled.worldFromCamera * glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 0, 1));
    const ViewCamera turnedCamera = orbited(rolled, 1.1, 0);
    EXPECT_NEAR(turnedCamera.worldFromCamera[0].y, rolled.worldFromCamera[0].y, 1e-12);
    EXPECT_NEAR(turnedCamera.worldFromCamera[1].y, rolled.worldFromCamera[1].y, 1e-12);
}

TEST(CameraControls, lookingAroundKeepsThePlace) {
    const ViewCamera camera = turned(example(), 0.7, 0.2);
    expectNear(camera.position(), example().position(), 1e-9);
    EXPECT_NEAR(std::asin(camera.forward().y) - std::asin(example().forward().y), 0.2, 1e-9);
}

TEST(CameraControls, panMovesCameraAndPivotAlike) {
    const ViewCamera camera = panned(example(), 0.3, -0.2);
    expectNear(camera.pivot() - camera.position(), example().pivot() - example().position(), 1e-9);
    const glm::dvec3 offset =
        glm::transpose(glm::dmat3(camera.worldFromCamera)) * (camera.position() - example().position());
    expectNear(offset, {0.3, -0.2, 0}, 1e-9);
}

TEST(CameraControls, zoomKeepsThePivotAndNeverReachesIt) {
    ViewCamera camera = zoomed(example(), 0.5);
    expectNear(camera.pivot(), example().pivot(), 1e-9);
    EXPECT_NEAR(camera.pivotDistance, 0.5 * example().pivotDistance, 1e-12);
    for (int i = 0; i < 1000; ++i) camera = zoomed(camera, 0.5);
    EXPECT_GT(camera.pivotDistance, 0);
    for (int i = 0; i < 1000; ++i) camera = zoomed(camera, 2);
    EXPECT_TRUE(std::isfinite(camera.position().x));
}

TEST(CameraControls, flyingAheadAndBackReturns) {
    const ViewCamera camera = flown(flown(example(), {1, 2, 3}), {-1, -2, -3});
    expectNear(camera.position(), example().position(), 1e-9);
    expectNear(flown(example(), {0, 1, 0}).position() - example().position(), {0, 1, 0}, 1e-9);
    expectNear(flown(example(), {0, 0, 2}).position() - example().position(), 2.0 * example().forward(), 1e-9);
}

TEST(CameraControls, framedSphereTouchesTheNarrowerSide) {
    const Bounds bounds{{-1, 0, 2}, {3, 2, 4}};
    const double tanX = 0.36;
    const double tanY = 0.27;
    const ViewCamera camera = framed(example(), bounds, tanX, tanY);
    expectNear(camera.pivot(), bounds.centre(), 1e-9);
    expectNear(camera.forward(), example().forward(), 1e-9);
    const double radius = 0.5 * glm::length(bounds.size());
    EXPECT_NEAR(std::asin(radius / camera.pivotDistance), std::atan(tanY), 1e-9);
    expectNear(framed(example(), {}, tanX, tanY).position(), example().position(), 1e-9);
}

TEST(CameraControls, raysMeetTheCornersOfTheImage) {
    const glm::dvec3 ray = rayThrough(example(), {1, -1}, 0.4, 0.3);
    EXPECT_NEAR(glm::dot(ray, example().forward()), 1, 1e-12);
    EXPECT_NEAR(glm::dot(ray, glm::dvec3(example().worldFromCamera[0])), 0.4, 1e-12);
    EXPECT_NEAR(glm::dot(ray, glm::dvec3(example().worldFromCamera[1])), -0.3, 1e-12);
}

}  // namespace
}  // namespace defocus::engine
