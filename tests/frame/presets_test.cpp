// Tests that presets change exactly the settings that they list, and that plans of jeong2011 follow the paper's
// formulas. The tests repeat these formulas and compute them only from the scene and the camera.

#include "frame/settings/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "frame/settings/settings.h"
#include "frame/setup/prepared_frame.h"
#include "plan/frame_plan.h"
#include "plan/motion/object_pose.h"

namespace defocus::engine {
namespace {

const Preset& jeong() {
    return presetNamed("jeong2011");
}

TEST(Presets, setWhatTheyList) {
    for (const Preset& preset : presets()) {
        Request request;
        EXPECT_EQ(presetOf(request), nullptr);
        applyPreset(preset, request);
        EXPECT_EQ(presetOf(request), &preset);
        for (const PresetValue& value : preset.values) {
            const Setting* const setting = settingNamed(value.setting);
            ASSERT_NE(setting, nullptr) << value.setting;
            EXPECT_EQ(setting->text(request), value.text) << value.setting;
        }
        // clearPreset() resets only the settings that the preset lists. If all settings are then at their defaults,
        // applyPreset() has set no others.
        clearPreset(preset, request);
        for (const Setting& setting : settings()) EXPECT_FALSE(changedText(setting, request)) << setting.name;
    }
    EXPECT_THROW(presetNamed("jeong2013"), UsageError);
}

TEST(Presets, areLeftByAnotherValue) {
    for (const PresetValue& value : jeong().values) {
        Request request;
        applyPreset(jeong(), request);
        if (value.setting == "lod")  // this value of the preset equals the default, so another value is set
            request.lod = LodMode::nearest;
        else
            settingNamed(value.setting)->clear(request);
        EXPECT_EQ(presetOf(request), nullptr) << value.setting;
    }
}

TEST(Presets, comeBeforeWhatTheySet) {
    for (const Preset& preset : presets())
        for (const PresetValue& value : preset.values)
            EXPECT_LT(settingNamed("preset"), settingNamed(value.setting)) << preset.name << " " << value.setting;
}

// For each object, the plan draws the level whose edge length is nearest, on a logarithmic scale, to a target. The
// target is the edge length of level 0 times 0.25 (the preset's blur threshold) times the object's score. The score is
// the blur divided by the projected edge length of level 0 (Tzeng et al. 2012). The test computes the score from the
// plan's bounding boxes and blur.
TEST(TzengPlan, drawsTheLevelNearestToTheScore) {
    Request request;
    request.fishCount = 5;
    request.trianglesPerFish = 20'000;
    request.noCache = true;
    request.lens.fStop = 0.4;
    setByName(request, "preset", "tzeng2012");
    const PreparedFrame frame = prepareFrame(request);
    const FramePlan plan = planFrame(frame.world, frame.view, frame.settings);
    std::set<std::uint32_t> levels;
    for (const ObjectPlan& object : plan.objects) {
        const Pyramid& pyramid = frame.world.pyramids[static_cast<std::size_t>(object.mesh)];
        ASSERT_EQ(pyramid.levels.size(), 3u);
        const double depth = -0.5 * (object.viewBox.minimum.z + object.viewBox.maximum.z);
        const double edge = pyramid.levels[0].meanEdge * largestScale(object.pose) * plan.view.width /
                            (2 * plan.tanHalfHorizontal * depth);
        // Target edge length relative to level 0: the blur threshold times the object's score.
        const double growth = 0.25 * object.coc.smallest / edge;
        std::size_t expected = 0;
        for (std::size_t l = 1; l < 3; ++l) {
            const double middle = std::sqrt(pyramid.levels[l - 1].meanEdge * pyramid.levels[l].meanEdge);
            if (growth * pyramid.levels[0].meanEdge > middle) expected = l;
        }
        EXPECT_EQ(object.fine.level, expected) << object.name;
        EXPECT_EQ(object.fine.sampleCount, plan.samples.size());
        levels.insert(object.fine.level);
    }
    EXPECT_GE(levels.size(), 2u);
}

// Fixture with six fish, from in focus to strongly blurred.
class JeongPlan : public testing::Test {
protected:
    static void SetUpTestSuite() {
        Request request = asked(64);
        frame_ = new PreparedFrame(prepareFrame(request));
    }
    static void TearDownTestSuite() {
        delete frame_;
        frame_ = nullptr;
    }
    static Request asked(std::uint32_t samples) {
        Request request;
        request.fishCount = 6;
        request.trianglesPerFish = 30'000;
        request.noCache = true;
        request.lens.fStop = 0.5;
        setByName(request, "preset", "jeong2011");
        request.samples = samples;
        return request;
    }
    static FramePlan planOf(std::uint32_t samples) {
        return planFrame(frame_->world, frame_->view, renderSettings(asked(samples)));
    }
    static inline PreparedFrame* frame_ = nullptr;
};

// Returns the radical inverse of `index`: its digits in `base`, mirrored at the radix point (Halton 1960).
double mirrored(std::uint32_t index, std::uint32_t base) {
    double result = 0;
    for (double weight = 1.0 / base; index > 0; index /= base, weight /= base) result += (index % base) * weight;
    return result;
}

// Maps the unit square to the unit disk (Shirley and Chiu 1997, A Low Distortion Map Between Disk and Square).
glm::dvec2 onDisk(double x, double y) {
    const double a = 2 * x - 1;
    const double b = 2 * y - 1;
    if (a == 0 && b == 0) return {0, 0};
    const double quarter = std::numbers::pi / 4;
    const double radius = std::abs(a) > std::abs(b) ? a : b;
    const double angle = std::abs(a) > std::abs(b) ? quarter * (b / a) : 2 * quarter - quarter * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

TEST_F(JeongPlan, samplesAreHaltonsPointsFrom1On) {
    const FramePlan plan = planOf(64);
    ASSERT_EQ(plan.samples.size(), 64u);
    // The Halton points are shifted together, modulo 1, so that the first lies at the centre of the lens.
    const auto moved = [](std::uint32_t i, std::uint32_t base) {
        const double x = mirrored(i + 1, base) - 1.0 / base + 0.5;
        return x - std::floor(x);
    };
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::dvec2 expected = onDisk(moved(i, 2), moved(i, 3));
        EXPECT_NEAR(plan.samples[i].lens.x, expected.x, 1e-6) << "sample " << i;
        EXPECT_NEAR(plan.samples[i].lens.y, expected.y, 1e-6) << "sample " << i;
    }
}

TEST_F(JeongPlan, levelsAreProportionalToTheBlurOverTheBox) {
    for (const std::uint32_t samples : {16u, 64u, 512u}) {
        const FramePlan plan = planOf(samples);
        const Lens& lens = plan.view.lens;
        const double tanHalfWidth = lens.horizontalAperture / (2 * lens.focalLength);
        const double aperture = lens.focalLength / (1000 * lens.fStop);
        int between = 0;
        ASSERT_GE(plan.objects.size(), 5u);
        for (const ObjectPlan& object : plan.objects) {
            SCOPED_TRACE(object.name);
            const double centre = -object.viewBox.centre().z;
            const double pixels = plan.view.width / (2 * tanHalfWidth);  // size of 1 m at a distance of 1 m, px
            const double blur = aperture * std::abs(1 / lens.focusDistance - 1 / centre) * pixels;
            const glm::dvec3 box = object.viewBox.size();
            const double size = std::max(box.x, box.y) * pixels / centre;
            const Pyramid& pyramid = frame_->world.pyramids[static_cast<std::size_t>(object.mesh)];
            const auto coarsest = static_cast<double>(pyramid.levels.size() - 1);
            EXPECT_NEAR(object.lambda, std::min(proportionalLevels * blur / size, coarsest), 1e-6);

            // In jeong2011, the first samples draw the coarser of two levels, and the others the finer level.
            const double integerPart = std::floor(object.lambda);
            const auto coarse = static_cast<std::uint32_t>(std::lround((object.lambda - integerPart) * samples));
            EXPECT_EQ(object.coarse.sampleCount, coarse);
            EXPECT_EQ(object.coarse.firstSample, 0u);
            EXPECT_EQ(object.fine.firstSample, coarse);
            EXPECT_EQ(object.fine.sampleCount, samples - coarse);
            EXPECT_EQ(object.fine.level, static_cast<std::uint32_t>(integerPart));
            if (coarse > 0) {
                EXPECT_EQ(object.coarse.level, object.fine.level + 1);
            }
            between += object.lambda > 0 && object.lambda < coarsest ? 1 : 0;
        }
        EXPECT_GT(between, 2);
    }
}

// Only the blur selects coarser levels: without depth of field, small and distant objects keep full detail.
TEST_F(JeongPlan, sharpObjectsAreDrawnAtFullDetail) {
    Request request = asked(64);
    request.lens.blurScale = 0;
    View view = frame_->view;
    view.lens.blurScale = 0;
    for (const ObjectPlan& object : planFrame(frame_->world, view, renderSettings(request)).objects)
        EXPECT_EQ(object.lambda, 0) << object.name;
}

TEST_F(JeongPlan, levelsHaveTheValuesOfLevel0) {
    for (std::size_t m = 0; m < frame_->world.pyramids.size(); ++m) {
        const Pyramid& pyramid = frame_->world.pyramids[m];
        const Vertices& own = frame_->scene->meshes[m].vertices;
        ASSERT_GT(pyramid.levels.size(), 2u);
        for (const PyramidLevel& level : pyramid.levels)
            for (std::uint32_t v = 0; v < level.vertexCount; ++v) {
                ASSERT_EQ(level.positions[v], own.positions[pyramid.source[v]]);
                ASSERT_EQ(level.normals[v], own.normals[pyramid.source[v]]);
                if (!own.colors.empty()) {
                    ASSERT_EQ(level.colors[v], own.colors[pyramid.source[v]]);
                }
            }
    }
}

}  // namespace
}  // namespace defocus::engine
