#include "frame/report/plan_warnings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "frame/setup/prepared_frame.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Returns a world with quads of 2 × 2 m at these depths in front of a uniform background. The lens is focused at 4 m.
std::unique_ptr<SmallWorld> quadsAt(const std::vector<double>& depths) {
    auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial(glm::vec4(1)));
    small->scene.meshes.push_back(quad(0));
    for (const double depth : depths) place(*small, 0, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -depth)));
    small->world.environment.type = EnvironmentType::uniform;
    small->view.width = 320;
    small->view.height = 240;
    small->view.lens.focusDistance = 4;
    finish(*small);
    return small;
}

std::vector<std::string> warningsOf(const SmallWorld& small, std::uint32_t samples = 64,
                                    const char* method = "accumulation") {
    const RenderSettings settings{.sampleCount = samples};
    return planWarnings(planFrame(small.world, small.view, settings), parseMethodUse(method));
}

double numberAfter(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + words.size(), nullptr);
}

TEST(PlanWarnings, thereAreNoneForABlurThatShowsAndIsFilled) {
    const auto small = quadsAt({4, 8});
    small->view.lens.fStop = 1.4;
    EXPECT_TRUE(warningsOf(*small).empty());
}

TEST(PlanWarnings, aBlurThatNoSamplesResolveIsNamedWithAScaleThatHelps) {
    const auto small = quadsAt({2});
    small->view.lens.fStop = 1e-4;
    const std::vector<std::string> lines = warningsOf(*small, 32);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("more than 1,024 times"), std::string::npos) << lines[0];
    small->view.lens.blurScale = numberAfter(lines[0], "--blur-scale ");
    EXPECT_TRUE(warningsOf(*small, 256).empty());
}

TEST(PlanWarnings, boundedDivisionsAreNamed) {
    const auto small = quadsAt({3});
    small->view.lens.fieldCurvature = 10;
    RenderSettings settings;
    FramePlan plan = planFrame(small->world, small->view, settings);
    ASSERT_EQ(plan.objects.at(0).refinement, Refinement::subdivide);
    const auto says = [&] {
        for (const std::string& line : planWarnings(plan, parseMethodUse("accumulation")))
            if (line.find("1 object varies") != std::string::npos) return line.find("at most 8 parts") != line.npos;
        return false;
    };
    EXPECT_FALSE(says());
    plan.objects[0].maxParts = 8;
    EXPECT_TRUE(says());
}

TEST(PlanWarnings, anOpenLensThatBlursNothingIsNamedWithAScaleThatHelps) {
    const auto small = quadsAt({227, 600});
    small->view.lens.fStop = 1.4;
    small->view.lens.focusDistance = 230;
    const std::vector<std::string> lines = warningsOf(*small);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("227 m away"), std::string::npos) << lines[0];
    small->view.lens.blurScale = numberAfter(lines[0], "--blur-scale ");
    RenderSettings settings;
    const double blur = planFrame(small->world, small->view, settings).largestBlur;
    // The warning rounds its suggestion to 1, 2 or 5 times a power of ten, here by a factor below 1.7.
    EXPECT_GT(blur, 0.02 * small->view.width / 1.7);
    EXPECT_LT(blur, 0.02 * small->view.width * 1.7);
    EXPECT_TRUE(warningsOf(*small).empty());
}

TEST(PlanWarnings, noScaleIsNamedThatNoLensTakes) {
    const auto small = quadsAt({2.27e9, 2.4e9});
    small->view.lens.focusDistance = 2.3e9;
    const std::vector<std::string> lines = warningsOf(*small);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("units"), std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].find("--blur-scale"), std::string::npos) << lines[0];
}

TEST(FrameWarnings, scenesThatSinglePrecisionCannotHoldAreNamed) {
    const auto linesFor = [](double reach) {
        PreparedFrame frame;
        frame.scene = std::make_shared<Scene>();
        frame.view.lens.focusDistance = 2;
        frame.world.pose.bounds = {glm::dvec3(-reach), glm::dvec3(reach)};
        return frameWarnings(frame);
    };
    EXPECT_TRUE(linesFor(1e-12).empty());
    EXPECT_TRUE(linesFor(1e12).empty());
    for (const double reach : {1e-20, 1e20}) {
        const std::vector<std::string> lines = linesFor(reach);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].find("may be drawn incorrectly"), std::string::npos);
    }
}

TEST(PlanWarnings, aClosedLensNeedsNone) {
    const auto small = quadsAt({227});
    small->view.lens.dofEnabled = false;
    EXPECT_TRUE(warningsOf(*small).empty());
}

TEST(PlanWarnings, copiesAreNamedWithANumberOfSamplesAndAScaleThatFill) {
    const auto small = quadsAt({0.5, 4});
    small->view.lens.fStop = 0.2;
    const std::vector<std::string> lines = warningsOf(*small, 32);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(numberAfter(lines[0], "up to "), planFrame(small->world, small->view, {}).largestBlur, 0.5);
    const double enough = numberAfter(lines[0], "about ");
    ASSERT_GT(enough, 32);
    EXPECT_TRUE(warningsOf(*small, static_cast<std::uint32_t>(enough)).empty());
    small->view.lens.blurScale = numberAfter(lines[0], "--blur-scale ");
    EXPECT_TRUE(warningsOf(*small, 32).empty());
}

// Fewer samples suffice with lens cells: each sample's image is blurred over its part of the lens (its cell), which
// fills the gaps between samples.
TEST(PlanWarnings, lensCellsNeedFewerSamples) {
    const auto small = quadsAt({0.5, 4});
    small->view.lens.fStop = 0.2;
    ASSERT_FALSE(warningsOf(*small, 64).empty());
    EXPECT_TRUE(warningsOf(*small, 64, "multirate").empty());
    const std::vector<std::string> lines = warningsOf(*small, 8, "multirate");
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(warningsOf(*small, static_cast<std::uint32_t>(numberAfter(lines[0], "about ")), "multirate").empty());
    small->view.lens.blurScale = numberAfter(lines[0], "--blur-scale ");
    EXPECT_TRUE(warningsOf(*small, 8, "multirate").empty());
}

TEST(PlanWarnings, anObjectAroundTheCameraSaysNothingOfItsBlur) {
    auto small = quadsAt({4});
    small->view.lens.fStop = 1.4;
    place(*small, 0,
          glm::rotate(glm::scale(glm::dmat4(1), glm::dvec3(100)), 0.5 * std::numbers::pi, glm::dvec3(1, 0, 0)));
    EXPECT_TRUE(std::isinf(planFrame(small->world, small->view, {}).largestBlur));
    EXPECT_TRUE(warningsOf(*small).empty());
}

TEST(PlanWarnings, methodsThatDrawGlassOpaqueSaySo) {
    const auto small = quadsAt({4, 8});
    RenderSettings settings;
    const auto linesOf = [&](const char* method) {
        return planWarnings(planFrame(small->world, small->view, settings), parseMethodUse(method));
    };
    EXPECT_TRUE(linesOf("stochastic").empty());
    small->scene.materials[0].unlit = false;
    small->scene.materials[0].transmissionFactor = 1;
    EXPECT_TRUE(linesOf("accumulation").empty());
    EXPECT_TRUE(linesOf("multirate").empty());
    for (const char* method : {"stochastic", "line"}) {
        const std::vector<std::string> lines = linesOf(method);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].find("drawn opaque"), std::string::npos) << lines[0];
    }
}

TEST(PlanWarnings, whatIsIgnoredIsNamedAndDamageIsNot) {
    Scene scene;
    scene.ignored = {
        {"extension KHR_x", "not supported"}, {"lines", "only triangles are drawn", 3}, {"a", "b", 1, true}};
    EXPECT_EQ(ignoredWarnings(scene),
              (std::vector<std::string>{"extension KHR_x: not supported", "3 x lines: only triangles are drawn"}));
}

TEST(PlanWarnings, ofManyIgnoredThingsAFewAreNamed) {
    Scene scene;
    for (int i = 0; i < 1020; ++i) scene.ignored.push_back({"extension " + std::to_string(i), "not supported"});
    const std::vector<std::string> lines = ignoredWarnings(scene);
    ASSERT_EQ(lines.size(), 21u);
    EXPECT_EQ(lines.back(), "1,000 more kinds of content are ignored");
    scene.ignored.resize(21);
    EXPECT_EQ(ignoredWarnings(scene).back(), "1 more kind of content is ignored");
}

// Two of three nodes share a name, and --focus-node gives this name.
TEST(RequestWarnings, listNodesThatShareTheRequestedName) {
    Request request;
    request.focus = FocusNode{"Cube"};
    PreparedFrame frame;
    frame.scene = std::make_shared<Scene>();
    for (const char* name : {"Ball", "Cube", "Cube"}) {
        frame.scene->roots.push_back(static_cast<int>(frame.scene->nodes.size()));
        Node& node = frame.scene->nodes.emplace_back();
        node.name = name;
        node.translation.x = static_cast<double>(frame.scene->nodes.size());
    }
    frame.world.pose = poseAt(*frame.scene, 0);
    const std::vector<std::string> lines = requestWarnings(request, frame);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(
        lines[0],
        "2 nodes are named 'Cube': #1 at (2, 0, 0), #2 at (3, 0, 0); #1 is used; to use another node, give its number");
    for (const char* name : {"Ball", "#2"}) {
        request.focus = FocusNode{name};
        EXPECT_TRUE(requestWarnings(request, frame).empty()) << name;
    }
}

}  // namespace
}  // namespace defocus::engine
