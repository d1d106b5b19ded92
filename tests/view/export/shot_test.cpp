// Tests that `defocus capture` reads the viewer's exported keyframes unchanged.

#include "view/export/shot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "capture/shot_json.h"
#include "capture/shot_options.h"
#include "frame/setup/exposure.h"
#include "view/random_view.h"

namespace defocus::engine {
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
    Request options;
    options.scene = "a scene.glb";
    options.samples = 12;
    const std::vector<ShotKey> keys = {keyAt({0, 1, 5}, 2, 1.4), keyAt({3, 1, 4}, 4.5, 2.8)};
    const Shot shot = parseShot(shotJson({options, Lens{}, keys, 1, {ToneMap::agx, -1}}), "x.json");
    EXPECT_EQ(shot.request.scene.filename(), "a scene.glb");
    EXPECT_EQ(shot.range.first, 0);
    EXPECT_EQ(shot.range.last, framesBetweenKeys);
    EXPECT_EQ(shot.request.samples, 12u);
    EXPECT_EQ(shot.request.size.width, 320);
    EXPECT_EQ(shot.request.toneMap, ToneMap::agx);
    EXPECT_EQ(shot.request.exposure, Exposure(ExposureValue{-1}));
    const auto& camera = std::get<CameraKeys>(shot.movement);
    ASSERT_EQ(camera.positions.size(), 2u);
    EXPECT_EQ(std::get<glm::dvec3>(camera.positions[1].value), glm::dvec3(keys[1].view.worldFromCamera[3]));
    EXPECT_NEAR(glm::length(std::get<glm::dvec3>(camera.targets[1].value)), 0, 1e-12);
    ASSERT_EQ(shot.focus->keys.size(), 2u);
    EXPECT_EQ(std::get<FocusDistance>(shot.focus->keys[1].value).metres, 4.5);
    ASSERT_EQ(shot.lens.at("fStop").keys.size(), 2u);
    EXPECT_EQ(shot.lens.at("fStop").keys[1].value, 2.8);
    EXPECT_EQ(shot.lens.at("focalLength").keys.size(), 1u);
    EXPECT_FALSE(shot.lens.contains("bladeCount"));
}

TEST(ViewShot, oneKeyOfTheSchoolIsAShotToo) {
    ShotKey key = keyAt({0, 0, 3}, 1e300, 2);
    key.view.lens.focusBreathing = true;
    key.view.lens.bladeCount = 7;
    const Request options;
    const Shot shot = parseShot(shotJson({options, Lens{}, {key}, 1, {}}), "x.json");
    EXPECT_TRUE(shot.request.scene.empty());
    EXPECT_EQ(shot.range.last, 0);
    EXPECT_EQ(shot.lens.at("focusBreathing").keys[0].value, 1);
    EXPECT_EQ(shot.lens.at("bladeCount").keys[0].value, 7);
}

TEST(ViewShot, clipTimeSpeedAndShutterAreSaid) {
    Request options;
    options.clip = "Run";
    options.shutter = 0.02;
    options.shutterPosition = ShutterPosition::end;
    options.motionSegments = 4u;
    ShotKey key = keyAt({0, 0, 3}, 2, 2);
    key.time = 0.75;
    const Shot shot = parseShot(shotJson({options, Lens{}, {key}, 0.5, {}}), "x.json");
    EXPECT_EQ(shot.request.clip, "Run");
    EXPECT_EQ(shot.request.time, 0.75);
    EXPECT_EQ(shot.animationSpeed, 0.5);
    EXPECT_EQ(shot.request.shutter, options.shutter);
}

// The roll angle is continuous over keyframes: a camera that rolls past 180° does not spin back.
TEST(ViewShot, rollGoesTheShortWay) {
    std::vector<ShotKey> keys(3, keyAt({0, 1, 5}, 2, 2));
    const double degrees[] = {170, 190, 350};
    for (std::size_t i = 0; i < 3; ++i)
        keys[i].view.worldFromCamera =
            glm::rotate(keys[i].view.worldFromCamera, glm::radians(degrees[i]), glm::dvec3(0, 0, 1));
    const Request options;
    const Shot shot = parseShot(shotJson({options, Lens{}, keys, 1, {}}), "x.json");
    const auto& camera = std::get<CameraKeys>(shot.movement);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(camera.rolls[i].value, degrees[i], 1e-9);
}

// Returns the lens at a key of the shot file. Values in the file override those of `lens`, the scene camera's lens.
Lens lensAtKey(const Shot& shot, std::size_t key, Lens lens) {
    for (const auto& [name, track] : shot.lens)
        setLensField(lens, *lensFieldNamed(name), track.keys[track.keys.size() == 1 ? 0 : key].value);
    lens.focusDistance = std::get<FocusDistance>(shot.focus->keys[key].value).metres;
    return lens;
}

// Expects that the request read from a shot file equals `options` in everything that the file stores.
void expectSameOfShot(const Request& read, const Request& options) {
    EXPECT_EQ(read.scene.filename(), options.scene);
    EXPECT_EQ(read.time, options.time);
    EXPECT_EQ(read.clip, options.clip);
    EXPECT_EQ(read.loop, options.loop);
    EXPECT_EQ(read.shutter.value_or(0), options.shutter.value_or(0));
    EXPECT_EQ(read.background, options.background);
    EXPECT_EQ(read.camera, options.camera);
    EXPECT_EQ(read.shutterPosition, options.shutterPosition);
    EXPECT_EQ(read.motionSegments, options.motionSegments);
    EXPECT_EQ(read.samples, options.samples);
    EXPECT_EQ(read.sequence, options.sequence);
    EXPECT_EQ(read.seed, options.seed);
    EXPECT_EQ(read.lod, options.lod);
    EXPECT_EQ(read.lodMetric, options.lodMetric);
    EXPECT_EQ(read.blurThreshold, options.blurThreshold);
    EXPECT_EQ(read.sizeThreshold, options.sizeThreshold);
    EXPECT_EQ(chosenMethod(read).text(), chosenMethod(options).text());
    EXPECT_EQ(read.layerFormat, options.layerFormat);
}

TEST(ViewShot, ofAnyViewsIsReadBackAsThoseViews) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        Request options = randomOptions(dice);
        // No environment map: the shot would contain its absolute path, which would differ from the path in `options`.
        options.environment.clear();
        Lens cameraLens;
        changeFields(cameraLens, dice);
        std::vector<ShotKey> keys(static_cast<std::size_t>(dice.integer(1, 3)));
        Lens lens = cameraLens;
        for (ShotKey& key : keys) {
            if (dice.coin()) changeFields(lens, dice);
            key.view.lens = lens;
            key.view.worldFromCamera = randomCamera(dice);
            key.view.width = dice.integer(1, 4000);
            key.view.height = dice.integer(1, 4000);
            key.pivotDistance = dice.number(0.1, 20);
            key.time = options.time;
        }
        const WriteOptions write{static_cast<ToneMap>(dice.integer(0, 2)), dice.coin() ? dice.number(-5, 5) : 0};
        const std::string text = shotJson({options, cameraLens, keys, 1, write});
        SCOPED_TRACE(text);

        const Shot shot = parseShot(text, "x.json");
        Request read;
        applyShot(shot, read);
        expectSameOfShot(read, options);
        EXPECT_EQ(read.size.width, keys.back().view.width);
        EXPECT_EQ(read.size.height, keys.back().view.height);
        EXPECT_EQ(shot.request.toneMap, write.toneMap);
        const bool ofLens =
            std::ranges::any_of(keys, [](const ShotKey& key) { return key.view.lens.exposureTime > 0; });
        const std::optional<double> exposure = exposureOf(shot.request);
        EXPECT_FALSE(exposure && ofLens);
        EXPECT_EQ(ofLens ? write.exposure : exposure.value_or(0), write.exposure);
        const auto& camera = std::get<CameraKeys>(shot.movement);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const Lens again = lensAtKey(shot, i, cameraLens);
            for (const LensField& field : lensFields()) {
                const bool brightness =
                    field.name == std::string_view("exposureTime") || field.name == std::string_view("iso");
                if (brightness && !ofLens) continue;
                // An unlimited value is stored as the max value that a file can hold.
                EXPECT_DOUBLE_EQ(std::min(field.max, lensFieldValue(again, field)),
                                 std::min(field.max, lensFieldValue(keys[i].view.lens, field)))
                    << field.name;
            }
            const glm::dmat4 upright =
                glm::inverse(glm::lookAt(std::get<glm::dvec3>(camera.positions[i].value),
                                         std::get<glm::dvec3>(camera.targets[i].value), glm::dvec3(0, 1, 0)));
            const glm::dmat4 placed = glm::rotate(upright, glm::radians(camera.rolls[i].value), glm::dvec3(0, 0, 1));
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    EXPECT_NEAR(placed[column][row], keys[i].view.worldFromCamera[column][row], 1e-9);
        }
    }
}

}  // namespace
}  // namespace defocus::engine
