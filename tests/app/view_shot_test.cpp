// Key frames of a window, read back as `defocus capture` reads them.

#include "app/view_shot.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "capture/shot_json.h"

namespace defocus {
namespace {

ShotKey keyAt(const glm::dvec3& position, double focus, double fStop) {
    ShotKey key;
    key.view.worldFromCamera = glm::inverse(glm::lookAt(position, glm::dvec3(0), glm::dvec3(0, 1, 0)));
    key.view.lens.focusDistance = focus;
    key.view.lens.fStop = fStop;
    key.view.width = 320;
    key.view.height = 200;
    key.pivotDistance = glm::length(position);
    return key;
}

TEST(ViewShot, isReadBackAsItWasTaken) {
    SceneOptions options;
    options.path = "a scene.glb";
    options.samples = 12;
    const std::vector<ShotKey> keys = {keyAt({0, 1, 5}, 2, 1.4), keyAt({3, 1, 4}, 4.5, 2.8)};
    const Shot shot = parseShot(shotJson(options, keys, {ToneMap::agx, -1}), "x.json");
    EXPECT_EQ(shot.scene.filename(), "a scene.glb");
    EXPECT_EQ(shot.range.first, 0);
    EXPECT_EQ(shot.range.last, framesBetweenKeys);
    EXPECT_EQ(shot.samples, 12u);
    EXPECT_EQ(shot.width, 320);
    EXPECT_EQ(shot.toneMap, ToneMap::agx);
    EXPECT_EQ(shot.exposure, -1);
    const auto& camera = std::get<CameraKeys>(shot.camera.movement);
    ASSERT_EQ(camera.positions.size(), 2u);
    EXPECT_EQ(std::get<glm::dvec3>(camera.positions[1].value), glm::dvec3(keys[1].view.worldFromCamera[3]));
    EXPECT_NEAR(glm::length(std::get<glm::dvec3>(camera.targets[1].value)), 0, 1e-12);
    ASSERT_EQ(shot.focus->keys.size(), 2u);
    EXPECT_EQ(std::get<double>(shot.focus->keys[1].value), 4.5);
    ASSERT_EQ(shot.lens.at("fStop").keys.size(), 2u);
    EXPECT_EQ(shot.lens.at("fStop").keys[1].value, 2.8);
    EXPECT_EQ(shot.lens.at("focalLength").keys.size(), 1u);
    EXPECT_FALSE(shot.lens.contains("bladeCount"));
}

TEST(ViewShot, oneKeyOfTheSchoolIsAShotToo) {
    ShotKey key = keyAt({0, 0, 3}, 1e300, 2);
    key.view.lens.focusBreathing = true;
    key.view.lens.bladeCount = 7;
    const Shot shot = parseShot(shotJson({}, {key}, {}), "x.json");
    EXPECT_TRUE(shot.scene.empty());
    EXPECT_EQ(shot.range.last, 0);
    EXPECT_EQ(shot.lens.at("focusBreathing").keys[0].value, 1);
    EXPECT_EQ(shot.lens.at("bladeCount").keys[0].value, 7);
}

}  // namespace
}  // namespace defocus
