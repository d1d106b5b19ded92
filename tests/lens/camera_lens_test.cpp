// Tests lenses that are created from a file's camera. They have the camera's field of view and, if the file states
// them, its sensor and focal length.
#include "lens/camera_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace defocus::engine {
namespace {

// Returns a camera with a focal length of 50 mm and a sensor of 36 × 24 mm; the vertical field of view fits the sensor.
Camera physicalCamera() {
    Camera camera;
    camera.yfov = 2 * std::atan(24.0 / (2 * 50));
    camera.physical = PhysicalCamera{50, {36, 24}};
    return camera;
}

Lens fitted(const Camera& camera, double aspect, Lens lens = {}, const std::set<std::string_view>& given = {}) {
    fitToCamera(lens, camera, aspect, [&](std::string_view name) { return given.contains(name); });
    return lens;
}

TEST(CameraLens, fieldOfViewIsTheCamerasForEveryAspect) {
    for (const double aspect : {0.5, 1.0, 1.5, 2.39})
        for (const bool physical : {false, true}) {
            Camera camera = physicalCamera();
            if (!physical) camera.physical.reset();
            EXPECT_NEAR(tanHalfHorizontalFov(fitted(camera, aspect)), aspect * 0.24, 1e-12) << aspect;
        }
}

TEST(CameraLens, withoutAPhysicalCameraTheSensorIs36Wide) {
    Camera camera = physicalCamera();
    camera.physical.reset();
    EXPECT_NEAR(fitted(camera, 1.5).focalLength, 50, 1e-12);
    EXPECT_NEAR(fitted(camera, 1).focalLength, 75, 1e-12) << "the same sensor width shows less of the scene";
    const Lens small{.horizontalAperture = 18};
    EXPECT_NEAR(fitted(camera, 1.5, small, {"horizontalAperture"}).focalLength, 25, 1e-12);
}

TEST(CameraLens, physicalCameraKeepsItsFocalLengthAndShowsAPartOfItsSensor) {
    EXPECT_NEAR(fitted(physicalCamera(), 1.5).focalLength, 50, 1e-12);
    EXPECT_NEAR(fitted(physicalCamera(), 1.5).horizontalAperture, 36, 1e-12);
    EXPECT_NEAR(fitted(physicalCamera(), 1).focalLength, 50, 1e-12);
    EXPECT_NEAR(fitted(physicalCamera(), 1).horizontalAperture, 24, 1e-12) << "as wide as high";
}

TEST(CameraLens, whatIsSetByNameWins) {
    Lens lens{.focalLength = 100};
    const Lens zoomed = fitted(physicalCamera(), 1.5, lens, {"focalLength"});
    EXPECT_EQ(zoomed.focalLength, 100);
    EXPECT_EQ(zoomed.horizontalAperture, 36) << "the sensor is still the file's";
    lens.horizontalAperture = 24;
    const Lens cropped = fitted(physicalCamera(), 1.5, lens, {"horizontalAperture"});
    EXPECT_EQ(cropped.horizontalAperture, 24);
    EXPECT_NEAR(tanHalfHorizontalFov(cropped), 0.36, 1e-12) << "the field of view is still the file's";
}

}  // namespace
}  // namespace defocus::engine
