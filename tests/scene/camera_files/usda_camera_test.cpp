// Compares cameras in USD text with values computed by hand from USD's rules.

#include "scene/camera_files/usda_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/error.h"
#include "near.h"
#include "scene/camera_files/usda_samples.h"
#include "scene/defaults.h"

namespace defocus::engine {
namespace {

CameraTrack camera(const std::string& text, const std::string& path = "") {
    return usdCamera(parseUsda(text, "shot.usda"), path, "shot.usda");
}

// Returns the error message for the USD source `text` in which `from` is replaced by `to`; empty if the source is
// accepted.
std::string refusal(std::string text, const std::string& from, const std::string& to, const std::string& path = "") {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
        const CameraTrack track = camera(text, path);
        static_cast<void>(track.at(0.5));
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(UsdCamera, convertsCentimetres) {
    const CameraTrack track = camera(usda_samples::plain, "/World/cam");
    EXPECT_FALSE(track.moves);
    EXPECT_TRUE(track.warnings.empty()) << track.warnings.front();
    const TrackedCamera tracked = track.at(0);
    EXPECT_EQ(tracked.camera.name, "cam");
    EXPECT_NEAR(tracked.camera.physical->focalLength, 50, 1e-12);
    EXPECT_NEAR(tracked.camera.physical->sensorSize.x, 36, 1e-12);
    EXPECT_NEAR(tracked.camera.physical->sensorSize.y, 24, 1e-12);
    EXPECT_NEAR(tracked.camera.yfov, 2 * std::atan(12.0 / 50), 1e-12);
    EXPECT_NEAR(tracked.camera.znear, 0.1, 1e-12);
    EXPECT_NEAR(*tracked.camera.lensValue("fStop"), 1.4, 1e-12);
    EXPECT_NEAR(*tracked.camera.lensValue("focusDistance"), 2.5, 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(tracked.worldFromCamera[3]), glm::dvec3(1, 0.2, 3)), 1e-12);
}

// If the image and the sensor differ in aspect ratio, the sensor is extended, as in USD's policy "expandAperture".
TEST(UsdCamera, showsTheWholeSensor) {
    Pose pose;
    pose.tracked = camera(usda_samples::plain).at(0);
    const auto tanHalf = [&](double aspect) {
        return std::tan(chooseCamera(Scene{}, pose, FirstCamera{}, aspect).camera.yfov / 2);
    };
    EXPECT_NEAR(tanHalf(1.5), 12.0 / 50, 1e-12);
    EXPECT_NEAR(tanHalf(3), 12.0 / 50, 1e-12) << "a wider image keeps the height";
    EXPECT_NEAR(tanHalf(0.75), 24.0 / 50, 1e-12) << "a narrower image keeps the width of 36 mm: 48 mm high";
}

// The file has z up. The camera looks along −z in its own axes. A rotation by 90° about x turns it towards +y, and a
// second rotation turns it by 30° about z. In y-up axes, USD's (x, y, z) is (x, z, −y).
TEST(UsdCamera, followsTimeSamplesInZUpLayers) {
    const CameraTrack track = camera(usda_samples::animated);
    EXPECT_TRUE(track.moves);
    ASSERT_TRUE(track.shutter);
    EXPECT_NEAR(track.shutter->open, -0.25 / 24, 1e-15);
    EXPECT_NEAR(track.shutter->close, 0.25 / 24, 1e-15);
    const TrackedCamera tracked = track.at(0.5);  // time code 12
    EXPECT_NEAR(tracked.camera.physical->focalLength, 50, 1e-12);
    EXPECT_NEAR(*tracked.camera.lensValue("fStop"), 2.5, 1e-12);
    EXPECT_NEAR(*tracked.camera.lensValue("focusDistance"), 2, 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(tracked.worldFromCamera[3]), glm::dvec3(0.5, 1, -1)), 1e-12);
    const double turn = std::numbers::pi / 6;
    const glm::dvec3 looking(-std::sin(turn), 0, -std::cos(turn));
    EXPECT_LT(glm::distance(-glm::dvec3(tracked.worldFromCamera[2]), looking), 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(tracked.worldFromCamera[1]), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_NEAR(*track.at(5).camera.lensValue("fStop"), 4, 1e-12) << "held after the last sample";
    EXPECT_NEAR(*track.at(-5).camera.lensValue("fStop"), 2, 1e-12);
}

TEST(UsdCamera, passesOverEverythingElse) {
    const CameraTrack track = camera(usda_samples::everything, "/Stage/cam");
    const TrackedCamera tracked = track.at(0.5);  // time code 12.5: half of the rotation about y
    EXPECT_EQ(tracked.camera.lensValue("bladeCount"), 7);
    EXPECT_EQ(tracked.camera.lensValue("dofEnabled"), 0) << "USD's fStop defaults to 0";
    EXPECT_LT(glm::distance(glm::dvec3(tracked.worldFromCamera[3]), 0.01 * glm::dvec3(5, 6, 7)), 1e-12)
        << "the default unit is 1 cm";
    // The rotation by 90° and its inverse cancel, because the uniform scale between them commutes with rotations.
    EXPECT_LT(glm::distance(glm::normalize(glm::dvec3(tracked.worldFromCamera[2])), glm::dvec3(1, 0, 0)), 1e-12);
    std::string warnings;
    for (const std::string& line : track.warnings) warnings += line + "\n";
    for (const char* part : {"references of Stage", "variants of Stage", "variantSets of Stage", "no fStop",
                             "horizontalApertureOffset is ignored"})
        EXPECT_NE(warnings.find(part), std::string::npos) << part << "\n" << warnings;
}

// Some programs write sensor sizes in millimetres into files whose unit is the metre.
TEST(UsdCamera, takesAnImpossibleSensorAsMillimetres) {
    std::string text = usda_samples::plain;
    text.replace(text.find("metersPerUnit = 0.01"), 20, "metersPerUnit = 1   ");
    const CameraTrack track = camera(text);
    EXPECT_NEAR(track.at(0).camera.physical->focalLength, 50, 1e-12);
    ASSERT_EQ(track.warnings.size(), 1u);
    EXPECT_NE(track.warnings[0].find("3.6 m wide"), std::string::npos) << track.warnings[0];
}

TEST(UsdCamera, isChosenByPathOrByName) {
    EXPECT_EQ(camera(usda_samples::plain, "cam").at(0).camera.name, "cam");
    const std::string two =
        "#usda 1.0\ndef Xform \"a\" { def Camera \"cam\" {} }\ndef Xform \"b\" { def Camera \"cam\" {} }\n";
    EXPECT_EQ(refusal(two, "cam", "cam", "cam"),
              "shot.usda: the file has several cameras of the name cam: /a/cam, /b/cam; give a path, such as "
              "shot.usda:/a/cam");
}

TEST(UsdCamera, refusesWhatItCannotRead) {
    const std::string plain = usda_samples::plain;
    EXPECT_NE(refusal(plain, "#usda 1.0", "PXR-USDC").find("usdcat"), std::string::npos);
    EXPECT_NE(refusal(plain, "#usda 1.0", "PK\x03\x04").find(".usdz"), std::string::npos);
    EXPECT_NE(refusal(plain, "#usda 1.0", "{}").find("not a USD text file"), std::string::npos);
    EXPECT_EQ(refusal(plain, "focalLength = 50", "focalLength = x50"),
              "shot.usda: /World/cam: focalLength must be a number")
        << "a token is no number";
    EXPECT_NE(refusal(plain, "focalLength = 50", "focalLength = 5o").find("line 18: '5o' is not a number"),
              std::string::npos);
    EXPECT_NE(refusal(plain, "def Camera", "def Xform").find("has no camera"), std::string::npos);
    EXPECT_NE(refusal(plain, "def Camera", "over Camera").find("has no 'def'"), std::string::npos);
    EXPECT_NE(refusal(plain, "\"cam\"", "\"eye\"", "/World/cam").find("the cameras are: /World/eye"),
              std::string::npos);
    EXPECT_NE(refusal(plain, "\"perspective\"", "\"orthographic\"").find("orthographic projection"), std::string::npos);
    EXPECT_NE(refusal(plain, "upAxis = \"Y\"", "upAxis = \"X\"").find("upAxis"), std::string::npos);
    EXPECT_NE(refusal(plain, "metersPerUnit = 0.01", "metersPerUnit = -1").find("metersPerUnit"), std::string::npos);
    EXPECT_NE(refusal(plain, "(0, 20, 300)", "(0, 20)").find("3 finite numbers"), std::string::npos);
    EXPECT_NE(refusal(plain, "(0, 20, 300)", "(0, inf, 300)").find("3 finite numbers"), std::string::npos);
    EXPECT_NE(refusal(plain, "[\"xformOp:translate\"]", "[\"xformOp:shear\"]").find("xformOp:shear"),
              std::string::npos);
    EXPECT_NE(refusal(plain, "(100, 0, 0)\n", "(100, 0, 0\n").find("expected ',' or ')'"), std::string::npos);
    EXPECT_NE(refusal(plain, "fStop = 1.4", "fStop = -1").find("fStop"), std::string::npos);
    EXPECT_NE(refusal(usda_samples::animated, "close = 0.25", "close = -1").find("shutter:close"), std::string::npos);
    const std::string deep(100, '(');
    EXPECT_NE(refusal(plain, "(0, 20, 300)", deep).find("nested too deeply"), std::string::npos);
}

TEST(UsdCamera, asksWhichOfSeveralCameras) {
    const std::string text = "#usda 1.0\ndef Camera \"a\" {}\ndef Scope \"s\" { def Camera \"b\" {} }\n";
    EXPECT_NE(refusal(text, "1.0", "1.0").find("/a, /s/b"), std::string::npos);
    EXPECT_NE(refusal(text, "1.0", "1.0", "/c").find("/a, /s/b"), std::string::npos);
    EXPECT_EQ(camera(text, "/s/b").at(0).camera.name, "b");
}

}  // namespace
}  // namespace defocus::engine
