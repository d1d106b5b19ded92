// Writes cameras in each format and reads them back: all values agree within 1e-6.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "scene/camera_files/camera_gltf.h"
#include "scene/camera_files/camera_json.h"
#include "scene/camera_files/camera_source.h"
#include "scene/camera_files/camera_usda.h"
#include "scene/defaults.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

constexpr double tolerance = 1e-6;

CameraTake take(int frames) {
    CameraTake result;
    result.name = "Caméra 1";
    result.aspect = 16.0 / 9;
    result.frameRate = 25;
    result.shutter = ShutterInterval{-0.01, 0.005};
    for (int frame = 0; frame < frames; ++frame) {
        CameraSample sample;
        sample.time = frame / result.frameRate;
        sample.worldFromCamera = glm::rotate(glm::translate(glm::dmat4(1.0), {1.25 + frame, -0.7, 3.1 / (1 + frame)}),
                                             0.9 + 0.4 * frame, glm::normalize(glm::dvec3(1, 2, -0.5)));
        sample.nearPlane = 0.03;
        sample.lens = {{"focalLength", 85.0 + frame},
                       {"horizontalAperture", 24.89},
                       {"fStop", 1.4 + 0.1 * frame},
                       {"focusDistance", 2.345 + frame},
                       {"bladeCount", 7},
                       {"bladeRotation", 12.5},
                       {"catEye", 0.3}};
        result.samples.push_back(sample);
    }
    return result;
}

void expectSame(const CameraSample& sample, double aspect, const CameraTrack& track) {
    Pose pose;
    pose.tracked = track.at(sample.time);
    const PlacedCamera placed = chooseCamera(Scene{}, pose, FirstCamera{}, aspect);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(placed.worldFromCamera[column][row], sample.worldFromCamera[column][row], tolerance)
                << column << " " << row;
    EXPECT_NEAR(aspect * std::tan(placed.camera.yfov / 2), tanHalfHorizontal(sample), tolerance);
    EXPECT_NEAR(placed.camera.znear, sample.nearPlane, tolerance);
    for (const auto& [name, value] : sample.lens) {
        if (name == "focalLength" || name == "horizontalAperture") continue;
        EXPECT_NEAR(placed.camera.lensValue(name).value_or(-1), value, tolerance * std::max(1.0, value)) << name;
    }
    // File formats with focal length and sensor size in mm preserve both values.
    if (placed.camera.physical) {
        EXPECT_NEAR(placed.camera.physical->focalLength, lensValueOf(sample, "focalLength", 0), tolerance);
        EXPECT_NEAR(placed.camera.physical->sensorSize.x, lensValueOf(sample, "horizontalAperture", 0), tolerance);
    } else {
        EXPECT_NEAR(placed.camera.lensValue("horizontalAperture").value_or(-1),
                    lensValueOf(sample, "horizontalAperture", 0), tolerance * 25);
    }
}

void roundTrip(const char* name, std::string (*textOf)(const CameraTake&), const std::string& camera, bool shutter) {
    const ScratchFolder folder;
    for (const int frames : {1, 3}) {
        SCOPED_TRACE(std::string(name) + ", frames: " + std::to_string(frames));
        const CameraTake written = take(frames);
        writeFile(folder / name, textOf(written));
        for (const std::string& source : {(folder / name).string(), (folder / name).string() + ":" + camera}) {
            const CameraTrack track = openCamera(source);
            EXPECT_EQ(track.moves, frames > 1);
            EXPECT_TRUE(track.warnings.empty());
            for (const CameraSample& sample : written.samples) expectSame(sample, written.aspect, track);
            ASSERT_EQ(track.shutter.has_value(), shutter);
            if (!shutter) continue;
            EXPECT_NEAR(track.shutter->open, -0.01, 1e-12);
            EXPECT_NEAR(track.shutter->close, 0.005, 1e-12);
        }
    }
}

TEST(CameraRoundTrip, usda) {
    roundTrip("camera.usda", cameraUsdaText, "/World/Cam__ra_1", true);
}

TEST(CameraRoundTrip, gltf) {
    roundTrip("camera.gltf", cameraGltfText, "Caméra 1", false);
}

TEST(CameraRoundTrip, json) {
    roundTrip("camera.json", cameraJsonText, "Caméra 1", true);
}

TEST(CameraRoundTrip, usdaWithoutDepthOfField) {
    CameraTake still = take(1);
    still.samples[0].lens["dofEnabled"] = 0;
    const ScratchFolder folder;
    writeFile(folder / "camera.usda", cameraUsdaText(still));
    EXPECT_EQ(openCamera((folder / "camera.usda").string()).at(0).camera.lensValue("dofEnabled"), 0);
}

TEST(CameraSource, isSplitAfterTheExtension) {
    EXPECT_EQ(cameraSourceOf("a:b/shot.usda:/World/cam").file, "a:b/shot.usda");
    EXPECT_EQ(cameraSourceOf("a:b/shot.usda:/World/cam").camera, "/World/cam");
    EXPECT_EQ(cameraSourceOf("scene.glb:Left: 2").camera, "Left: 2");
    EXPECT_EQ(cameraSourceOf("camera.json").camera, "");
    for (const char* wrong : {"shot.usdc", "shot.usdc:/cam", "shot.usdz", "shot.usd", "shot.fbx", ""})
        EXPECT_THROW(cameraSourceOf(wrong), Error) << wrong;
}

TEST(CameraJson, refusesOtherJson) {
    const std::string good = cameraJsonText(take(2));
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        EXPECT_THROW(jsonCamera(text, "", "camera.json"), Error) << to;
    };
    refused("{", "");
    refused("\"camera\"", "\"kamera\"");
    refused("\"samples\"", "\"sample\"");
    refused("\"time\": 0.04", "\"time\": 0.0");
    refused("\"nearPlane\": 0.03", "\"nearPlane\": 0");
    refused("\"focalLength\": 85.0", "\"focalLength\": 0");
    refused("\"open\": -0.01", "\"open\": 1");
    EXPECT_THROW(jsonCamera(good, "other", "camera.json"), Error);
    EXPECT_THROW(jsonCamera(std::string(1000, '['), "", "camera.json"), Error);
}

}  // namespace
}  // namespace defocus::engine
