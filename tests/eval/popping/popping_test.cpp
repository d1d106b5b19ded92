#include "eval/popping/popping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "eval/popping/text.h"
#include "plan/frame_plan.h"
#include "render/pops/level_change.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// ---- movements ------------------------------------------------------------------------------------------------------

std::unique_ptr<SmallWorld> spheres() {
    auto small = fiveSpheres();
    for (const Object& object : small->world.pose.objects)
        small->world.pose.bounds.extend(glm::dvec3(object.worldFromObject[3]));
    return small;
}

TEST(PoppingPaths, aWholeFocusPullGoesEvenlyInDioptresFromNearToFar) {
    const auto small = spheres();
    const std::vector<MovementFrame> frames = framesAlong(Movement::focusPull, small->world, small->view, 11);
    ASSERT_EQ(frames.size(), 11u);
    const double step = 1 / frames[1].view.lens.focusDistance - 1 / frames[0].view.lens.focusDistance;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        EXPECT_NEAR(1 / frames[i].view.lens.focusDistance - 1 / frames[i - 1].view.lens.focusDistance, step, 1e-12);
        EXPECT_EQ(frames[i].view.worldFromCamera, small->view.worldFromCamera);
    }
    // distance to the near side of the nearest sphere
    EXPECT_NEAR(frames.front().view.lens.focusDistance, 1.2 - 0.15, 0.01);
    // distance to the far side of the farthest sphere
    EXPECT_NEAR(frames.back().view.lens.focusDistance, 9 + 1, 0.05);
}

TEST(PoppingPaths, aDollyKeepsTheFocusOnItsPlane) {
    const auto small = spheres();
    const std::vector<MovementFrame> frames = framesAlong(Movement::dolly, small->world, small->view, 5);
    for (const MovementFrame& frame : frames)
        EXPECT_NEAR(frame.view.lens.focusDistance + -frame.view.worldFromCamera[3].z, 3, 1e-12);
    EXPECT_NEAR(frames.back().view.worldFromCamera[3].z - frames.front().view.worldFromCamera[3].z, -1.5, 1e-12);
    EXPECT_NEAR(frames[2].view.worldFromCamera[3].z, 0, 1e-12);
}

TEST(PoppingPaths, aTurntableKeepsTheDistanceFromTheMiddle) {
    const auto small = spheres();
    const glm::dvec3 centre = small->world.pose.bounds.centre();
    const std::vector<MovementFrame> frames = framesAlong(Movement::turntable, small->world, small->view, 9);
    for (const auto& [view, pose] : frames) {
        const glm::dvec3 eye = view.worldFromCamera[3];
        EXPECT_NEAR(glm::length(eye - centre), glm::length(centre), 1e-9);
        // The centre of the scene keeps its position in the image.
        const glm::dvec4 seen = glm::inverse(view.worldFromCamera) * glm::dvec4(centre, 1);
        EXPECT_NEAR(glm::length(glm::dvec3(seen) - centre), 0, 1e-9);
    }
    EXPECT_NEAR(glm::length(glm::dvec3(frames[4].view.worldFromCamera[3])), 0, 1e-9);
    EXPECT_NEAR(glm::length(glm::dvec3(frames[0].view.worldFromCamera[3] - frames[8].view.worldFromCamera[3])), 0,
                1e-9);
}

// The camera stands still while a clip plays once. In this clip of 2 s, the first sphere rises at 1 m/s.
TEST(PoppingPaths, aClipPlaysOnceBeforeACameraThatStandsStill) {
    const auto small = spheres();
    Node climber;
    climber.mesh = 0;
    climber.translation = {0, 0, -2};
    small->scene.nodes = {climber};
    small->scene.roots = {0};
    AnimationChannel climb;
    climb.target = 0;
    climb.times = {0, 2};
    climb.values = {0, 0, -2, 0, 2, -2};
    small->scene.clips = {{"Stand", {}, 1}, {"Climb", {climb}, 2}};
    const std::vector<MovementFrame> frames = framesAlong(Movement::clip, small->world, small->view, 9, 1);
    ASSERT_EQ(frames.size(), 9u);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].view.worldFromCamera, small->view.worldFromCamera);
        ASSERT_EQ(frames[i].pose.objects.size(), 1u);
        EXPECT_NEAR(frames[i].pose.objects[0].worldFromObject[3].y, 0.25 * static_cast<double>(i), 1e-6);
    }
    EXPECT_THROW(framesAlong(Movement::clip, small->world, small->view, 9, 2), Error);
    EXPECT_THROW(framesAlong(Movement::clip, small->world, small->view, 9, -1), Error);
}

TEST(PoppingPaths, impossibleMovementsAreErrors) {
    const auto small = spheres();
    EXPECT_THROW(framesAlong(Movement::dolly, small->world, small->view, 1), Error);
    small->view.worldFromCamera = glm::rotate(glm::dmat4(1), 3.14, glm::dvec3(0, 1, 0));
    EXPECT_THROW(framesAlong(Movement::dolly, small->world, small->view, 2), Error) << "the camera sees no object";
}

// The busiest stretch of a movement has more level changes in mode `nearest` than any other stretch of the same length.
TEST(PoppingPaths, theBusiestStretchHasTheMostChangesOfLevel) {
    const auto small = spheres();
    const std::vector<MovementFrame> frames = framesAlong(Movement::focusPull, small->world, small->view, 40);
    const RenderSettings settings{.lod = LodMode::nearest, .thresholds = {0.5, 2}};
    const auto changes = [&](const View& a, const View& b) {
        int changed = 0;
        for (const ObjectPlan& x : planFrame(small->world, a, settings).objects)
            for (const ObjectPlan& y : planFrame(small->world, b, settings).objects)
                changed += x.object == y.object && x.fine.level != y.fine.level ? 1 : 0;
        return changed;
    };
    int max = 0;
    for (std::size_t first = 0; first + 5 <= frames.size(); ++first) {
        int within = 0;
        for (std::size_t i = first; i < first + 4; ++i) within += changes(frames[i].view, frames[i + 1].view);
        max = std::max(max, within);
    }
    ASSERT_GT(max, 0);
    const std::vector<MovementFrame> stretch = busiestStretch(frames, small->world, settings, 5);
    ASSERT_EQ(stretch.size(), 5u);
    int within = 0;
    for (std::size_t i = 0; i < 4; ++i) within += changes(stretch[i].view, stretch[i + 1].view);
    EXPECT_EQ(within, max);
    EXPECT_EQ(busiestStretch(frames, small->world, settings, 40).size(), 40u);
    EXPECT_THROW(busiestStretch(frames, small->world, settings, 41), Error);
}

// ---- mask of the objects' pixels ------------------------------------------------------------------------------------

// If an object's pixel has a blur of 6 px, all pixels within 3 px of it count as pixels of objects. Background pixels
// do not affect their surroundings.
TEST(PoppingPixels, growByHalfTheBlur) {
    Image level(16, 12, 1);
    Image coc(16, 12, 1);
    std::fill(level.pixels.begin(), level.pixels.end(), -1.0f);
    std::fill(coc.pixels.begin(), coc.pixels.end(), 40.0f);
    *level.at(2, 6) = 0;
    *coc.at(2, 6) = -6;
    *level.at(14, 1) = 3;
    *coc.at(14, 1) = 0;
    const Image mask = objectPixels(level, coc);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool expected = (x - 2) * (x - 2) + (y - 6) * (y - 6) <= 9 || (x == 14 && y == 1);
            EXPECT_EQ(*mask.at(x, y), expected ? 1.0f : 0.0f) << x << ' ' << y;
        }
}

// ---- summaries of the frames ----------------------------------------------------------------------------------------

// Returns 101 frames whose image change is 0 … 100 in mode `nearest` and half as large in mode `fractional`. The 99th
// percentile is the second largest change.
std::vector<PoppingFrame> ramp() {
    std::vector<PoppingFrame> frames;
    for (int i = 0; i <= 100; ++i)
        for (const PoppingMode mode : {PoppingMode::nearest, PoppingMode::fractional}) {
            PoppingFrame frame;
            frame.movement = Movement::dolly;
            frame.samples = 8;
            frame.mode = mode;
            frame.frame = 101 - i;
            frame.speed = 0.01 * i;
            frame.step.objects.rmse = mode == PoppingMode::nearest ? i : 0.5 * i;
            frames.push_back(frame);
        }
    return frames;
}

TEST(PoppingRows, holdWorstPercentileAndShareOfTheNearestLevel) {
    const std::vector<PoppingRow> rows = poppingRows(ramp());
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].mode, PoppingMode::nearest);
    EXPECT_EQ(rows[0].frames, 101);
    EXPECT_DOUBLE_EQ(rows[0].speed, 1);
    EXPECT_DOUBLE_EQ(rows[0].stepRmse.worst, 100);
    EXPECT_EQ(rows[0].stepRmse.worstFrame, 1);
    EXPECT_DOUBLE_EQ(rows[0].stepRmse.percentile99, 99);
    EXPECT_DOUBLE_EQ(rows[0].stepRmse.ofNearest, 1);
    EXPECT_DOUBLE_EQ(rows[1].stepRmse.worst, 50);
    EXPECT_DOUBLE_EQ(rows[1].stepRmse.ofNearest, 0.5);
    EXPECT_TRUE(std::isnan(rows[1].changeFlip.ofNearest)) << "0 of 0";
}

TEST(PoppingRows, keepMovementsAndNumbersOfSamplesApart) {
    std::vector<PoppingFrame> frames = ramp();
    for (PoppingFrame frame : ramp()) {
        frame.samples = 16;
        frame.step.objects.rmse *= 10;
        frames.push_back(frame);
        frame.movement = Movement::turntable;
        frames.push_back(frame);
    }
    const std::vector<PoppingRow> rows = poppingRows(frames);
    ASSERT_EQ(rows.size(), 6u);
    for (const PoppingRow& row : rows) {
        EXPECT_EQ(row.frames, 101);
        EXPECT_DOUBLE_EQ(row.stepRmse.ofNearest, row.mode == PoppingMode::nearest ? 1 : 0.5);
    }
}

TEST(PoppingRows, firstFramesAreALineWithTheLargestPopOfEachMode) {
    EXPECT_EQ(
        firstFramesLine(ramp()),
        "first 102 frames of dolly, 8 samples, largest pop (RMSE over pixels covered by objects): nearest 100.00000, "
        "fractional 50.00000\n");
}

TEST(PoppingFiles, csvHoldsEveryChangeAndJsonTheWorst) {
    const std::vector<PoppingFrame> frames = ramp();
    const std::string csv = poppingCsv(frames);
    ASSERT_EQ(std::count(csv.begin(), csv.end(), '\n'), 203);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 203 * commas);
    EXPECT_TRUE(csv.starts_with("movement,samples,lod,frame,speed,changeRmse,"));

    SampleStep step;
    step.samples = 8;
    step.measured = 0.25;
    const auto json = nlohmann::json::parse(poppingJson(frames, std::vector{step}, {}, {}));
    EXPECT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["frames"], 101);
    EXPECT_TRUE(json["rows"][0]["changeFlip"]["ofNearest"].is_null());
    EXPECT_DOUBLE_EQ(json["sampleSteps"][0]["measured"].get<double>(), 0.25);
}

}  // namespace
}  // namespace defocus::engine
