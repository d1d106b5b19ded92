// Tests which still images are drawn with levels of detail if the request does not set the level mode.

#include "frame/setup/levels.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace defocus::engine {
namespace {

Request smallSchool(double fStop) {
    Request request;
    request.fishCount = 3;
    request.trianglesPerFish = 200;
    request.size.width = 640;
    request.size.height = 480;
    request.lens.fStop = fStop;
    return request;
}

LodMode chosenFor(const Request& request, std::size_t copies = 1) {
    PreparedFrame frame = placeFrame(request);
    const std::vector<Object> objects = frame.world.pose.objects;
    for (std::size_t i = 1; i < copies; ++i)
        frame.world.pose.objects.insert(frame.world.pose.objects.end(), objects.begin(), objects.end());
    chooseLevels(frame, request);
    return frame.settings.lod;
}

TEST(ChosenLevels, areOffInOneImageOfLittleBlur) {
    EXPECT_EQ(chosenFor(smallSchool(16)), LodMode::off);
    Request pinhole = smallSchool(0.95);
    pinhole.lens.dofEnabled = false;
    EXPECT_EQ(chosenFor(pinhole), LodMode::off);
}

TEST(ChosenLevels, areDrawnInWideBlur) {
    EXPECT_EQ(chosenFor(smallSchool(0.05)), LodMode::fractional);  // the fish are blurred by up to 35 px
}

TEST(ChosenLevels, areDrawnWhereManyObjectsShareMeshes) {
    EXPECT_EQ(chosenFor(smallSchool(16), 3), LodMode::off);
    EXPECT_EQ(chosenFor(smallSchool(16), 4), LodMode::fractional);
}

TEST(ChosenLevels, areDrawnWithFewerCopiesAtAHigherQuality) {
    Request fine = smallSchool(16);
    fine.quality = Quality::fine;
    EXPECT_EQ(chosenFor(fine), LodMode::off);
    EXPECT_EQ(chosenFor(fine, 2), LodMode::fractional);
}

TEST(ChosenLevels, areDrawnForAGivenNumberOfSamplesOrATarget) {
    Request request = smallSchool(16);
    request.samples = 16;
    EXPECT_EQ(chosenFor(request), LodMode::fractional);
    request.samples.reset();
    request.targetError = 0.01;
    EXPECT_EQ(chosenFor(request), LodMode::fractional);
}

TEST(ChosenLevels, followTheRequest) {
    Request request = smallSchool(16);
    request.lod = LodMode::nearest;
    EXPECT_EQ(chosenFor(request), LodMode::nearest);
    request.lod.reset();
    request.lightThreshold = 0.1;
    EXPECT_EQ(chosenFor(request), LodMode::fractional);
}

// If the scene reaches the near plane, its blur has no bound, so levels are drawn.
TEST(ChosenLevels, areDrawnWhereTheSceneReachesTheCamera) {
    Request request = smallSchool(16);
    PreparedFrame frame = placeFrame(request);
    ASSERT_FALSE(frame.world.pose.bounds.empty());
    frame.view.worldFromCamera = glm::translate(glm::dmat4(1), frame.world.pose.bounds.centre());
    chooseLevels(frame, request);
    EXPECT_EQ(frame.settings.lod, LodMode::fractional);
}

}  // namespace
}  // namespace defocus::engine
