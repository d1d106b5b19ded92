#include "plan/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "plan/plan_checks.h"
#include "plan/plan_text.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

TEST(FramePlan, everyObjectDrawsEverySampleOnce) {
    const auto small = fiveSpheres();
    for (const std::uint32_t n : {1u, 2u, 7u, 64u, 100u})
        for (const LodMode mode : {LodMode::fractional, LodMode::nearest, LodMode::off}) {
            RenderSettings settings = settingsFor(n);
            settings.lod = mode;
            for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects) {
                EXPECT_EQ(object.coarse.sampleCount + object.fine.sampleCount, n);
                if (object.coarse.sampleCount > 0) {
                    EXPECT_EQ(object.coarse.firstSample, 0u);
                }
                EXPECT_EQ(object.fine.firstSample, object.coarse.sampleCount);
                if (mode == LodMode::fractional && object.coarse.sampleCount > 0 && object.fine.sampleCount > 0) {
                    EXPECT_EQ(object.coarse.level, object.fine.level + 1);
                }
                if (mode != LodMode::fractional) {
                    EXPECT_EQ(object.coarse.sampleCount, 0u);
                }
            }
        }
}

// In LodMode::continuous, each lens sample draws one of an object's two levels of detail, except for at most one
// sample. This sample draws both levels, each in some of the pixels.
TEST(FramePlan, continuousLevelsOverlapByTheBoundarySample) {
    const auto small = fiveSpheres();
    int shared = 0;
    for (const std::uint32_t n : {1u, 2u, 7u, 64u, 100u}) {
        RenderSettings settings = settingsFor(n);
        settings.lod = LodMode::continuous;
        for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects) {
            const double fraction = object.lambda - std::floor(object.lambda);
            const std::optional<std::uint32_t> boundary = boundarySample(object);
            const double coarse = object.coarse.sampleCount - (boundary ? 1 - object.boundaryShare : 0);
            EXPECT_NEAR(coarse, fraction * n, 1e-9);
            EXPECT_EQ(object.coarse.firstSample, 0u);
            EXPECT_EQ(object.fine.firstSample + object.fine.sampleCount, n);
            EXPECT_EQ(object.coarse.sampleCount, object.fine.firstSample + (boundary ? 1 : 0));
            shared += boundary ? 1 : 0;
        }
    }
    EXPECT_GT(shared, 5);
}

TEST(FramePlan, otherModesHaveNoBoundarySample) {
    const auto small = fiveSpheres();
    for (const LodMode mode : {LodMode::fractional, LodMode::nearest, LodMode::off}) {
        RenderSettings settings = settingsFor(64);
        settings.lod = mode;
        for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects)
            EXPECT_FALSE(boundarySample(object)) << lodModeName(mode);
    }
}

TEST(FramePlan, depthsAndBlurFollowTheFormula) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(16));
    const ObjectPlan& nearest = plan.objects.front();  // the first object, since objects are sorted front to back
    EXPECT_EQ(nearest.object, 0);
    EXPECT_NEAR(nearest.nearestDepth, 1.05, 0.01);
    const double A = 0.05 / 1;
    const double expected = A * (1 / 3.0 - 1 / nearest.nearestDepth) * 160 / (36.0 / 50);
    EXPECT_NEAR(nearest.coc.nearest, expected, 1e-9);
    EXPECT_EQ(plan.objects[1].coc.smallest, 0) << "the object straddles the focus plane";
    EXPECT_TRUE(std::is_sorted(plan.objects.begin(), plan.objects.end(), [](const ObjectPlan& a, const ObjectPlan& b) {
        return a.nearestDepth < b.nearestDepth;
    }));
}

TEST(FramePlan, moreBlurAndDistanceMeanCoarserLevels) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    EXPECT_GT(plan.objects.back().lambda, plan.objects[1].lambda);
    EXPECT_LT(plan.trianglesDrawn, plan.trianglesAtFullDetail);
}

TEST(FramePlan, objectsOutsideTheWidenedFrustumAreLeftOut) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(16));
    EXPECT_TRUE(leftOut(plan, "Object 4"));
    RenderSettings everything = settingsFor(16);
    everything.keepAll = true;
    EXPECT_FALSE(leftOut(planFrame(small->world, small->view, everything), "Object 4"));
}

// No object whose blurred image reaches the frame is culled. The expected result is computed by brute force over lens
// points and corners of the bounding box.
TEST(FramePlan, cullingIsConservative) {
    const auto small = fiveSpheres();
    const Bounds box = small->world.pyramids[0].bounds;
    for (double x = -3; x <= 3; x += 0.13)
        for (const double z : {0.4, 1.0, 3.0, 6.0}) {
            auto& object = small->world.pose.objects[0];
            object.worldFromObject = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, -z)), glm::dvec3(0.1));
            const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
            bool seen = false;
            for (const glm::dvec3& corner : box.corners())
                for (const LensSample& sample : plan.samples) {
                    const glm::dvec4 p = object.worldFromObject * glm::dvec4(corner, 1);
                    const double w = -p.z;
                    if (w < small->view.nearPlane) continue;
                    const double ndcX =
                        (p.x / plan.tanHalfHorizontal + (plan.coc.a + plan.coc.front * w) * sample.lens.x) / w;
                    const double ndcY = (p.y / (plan.tanHalfHorizontal * 0.75) +
                                         (plan.coc.a + plan.coc.front * w) * sample.lens.y * 4 / 3) /
                                        w;
                    seen |= std::abs(ndcX) <= 1 && std::abs(ndcY) <= 1;
                }
            if (seen) {
                EXPECT_FALSE(leftOut(plan, "Object 0")) << x << " " << z;
            }
        }
}

TEST(FramePlan, nothingBlurredLeavesAntialiasingSamplesOnly) {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 2000;
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    EXPECT_FALSE(plan.usesLens);
    EXPECT_TRUE(leftOut(plan, "lens samples"));
    EXPECT_EQ(plan.samples.size(), antialiasingSamples);
    EXPECT_EQ(plan.apertureDiameter, 0);
}

TEST(FramePlan, unusedLevelsAreLeftOut) {
    const auto small = fiveSpheres();
    RenderSettings settings = settingsFor(16);
    settings.lod = LodMode::off;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    EXPECT_TRUE(plan.levelsUsed[0][0]);
    EXPECT_EQ(std::count(plan.levelsUsed[0].begin(), plan.levelsUsed[0].end(), true), 1);
    EXPECT_TRUE(leftOut(plan, "pyramid levels"));
}

TEST(FramePlan, boxThatReachesTheNearPlaneIsDrawnAtFullDetail) {
    const auto small = fiveSpheres();
    small->world.pose.objects[0].worldFromObject = glm::dmat4(1);  // the object surrounds the camera
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(16));
    const auto found =
        std::find_if(plan.objects.begin(), plan.objects.end(), [](const ObjectPlan& o) { return o.object == 0; });
    ASSERT_NE(found, plan.objects.end());
    EXPECT_EQ(found->lambda, 0);
}

struct DollyStep {
    double distance = 0;  // depth of the sphere's centre, m
    double lambda = 0;
};

constexpr double dollyRadius = 0.2;  // radius of the sphere, m

// Returns the distances and levels of detail λ of a sphere that moves from 1.2 to 12 m in front of the lens. Each step
// multiplies the distance by `ratio`.
std::vector<DollyStep> dolly(const RenderSettings& settings, double ratio) {
    const auto small = fiveSpheres();
    std::vector<DollyStep> steps;
    for (double z = 1.2; z < 12; z *= ratio) {
        small->world.pose.objects[0].worldFromObject =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -z)), glm::dvec3(dollyRadius));
        const FramePlan plan = planFrame(small->world, small->view, settings);
        const auto found = std::ranges::find(plan.objects, 0, &ObjectPlan::object);
        if (found != plan.objects.end()) steps.push_back({z, found->lambda});
    }
    EXPECT_GT(steps.size(), std::log(10) / std::log(ratio));
    return steps;
}

// The level of detail λ has no jumps while a sphere moves away from distance n to n'. An edge at distance n projects to
// a length proportional to 1/n. At λ, an object's edge length is interpolated logarithmically between levels and
// projects to τ = max(kBlur·c, kSize), with the blur c in px and the thresholds kBlur and kSize. Edges grow at least by
// the factor `growth` per level, so |Δλ| ≤ |Δ ln(n·τ)| / ln growth. Between n and n', τ changes only by the blur c =
// K·|1/s − 1/n|, with the focus distance s and a constant K of the lens. The change of τ is at most kBlur·K·(1/n −
// 1/n'), and τ is at least kSize. Hence |Δλ| ≤ (ln(n'/n) + kBlur·K·(1/n − 1/n')/kSize) / ln growth.
TEST(FramePlan, lambdaIsContinuousAlongADolly) {
    const RenderSettings settings = settingsFor(64);
    const auto small = fiveSpheres();
    const std::vector<PyramidLevel>& levels = small->world.pyramids[0].levels;
    double growth = std::numeric_limits<double>::infinity();
    for (std::size_t l = 1; l < levels.size(); ++l)
        growth = std::min(growth, levels[l].meanEdge / levels[l - 1].meanEdge);
    const Lens& lens = small->view.lens;
    // The factor K in the blur c = K·|1/s − 1/n| px of a point at distance n m, with the focus distance s in m.
    const double blur =
        lens.focalLength / (1000 * lens.fStop) * small->view.width * lens.focalLength / lens.horizontalAperture;
    const double reach = 1.03 * dollyRadius;  // radius of the sphere including its ripples, m
    const std::vector<DollyStep> steps = dolly(settings, 1.001);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const double before = steps[i - 1].distance - reach;
        const double after = steps[i].distance - reach;
        const double target = settings.thresholds.blur.value() * blur * (1 / before - 1 / after);
        const double max = (std::log(after / before) + target / settings.thresholds.size.value()) / std::log(growth);
        EXPECT_NEAR(steps[i].lambda, steps[i - 1].lambda, max) << steps[i].distance;
    }
}

TEST(FramePlan, measuredLevelsAreContinuousAlongADollyAndGrowWithBlur) {
    const RenderSettings settings{.sampleCount = 64, .metric = LodMetric::measured};
    const auto largestChange = [](const std::vector<DollyStep>& steps) {
        double largest = 0;
        for (std::size_t i = 1; i < steps.size(); ++i)
            largest = std::max(largest, std::abs(steps[i].lambda - steps[i - 1].lambda));
        return largest;
    };
    const std::vector<DollyStep> steps = dolly(settings, 1.002);
    // Halving the distance steps halves the largest change of the level of detail λ if λ is continuous, but not if λ
    // jumps.
    EXPECT_LT(largestChange(dolly(settings, 1.001)), 0.6 * largestChange(steps));
    const auto [finest, coarsest] = std::ranges::minmax(steps, {}, &DollyStep::lambda);
    EXPECT_GT(coarsest.lambda, finest.lambda + 1) << "levels coarsen from focus to blur";
}

TEST(FramePlan, moreSamplesMeanFinerMeasuredLevels) {
    const auto small = fiveSpheres();
    RenderSettings settings{.metric = LodMetric::measured};
    double last = 100;
    for (const std::uint32_t samples : {4u, 64u, 1024u}) {
        settings.sampleCount = samples;
        double sum = 0;
        for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects) sum += object.lambda;
        EXPECT_LT(sum, last);
        last = sum;
    }
    settings.thresholds.light = 0;
    for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects) EXPECT_EQ(object.lambda, 0);
}

TEST(FramePlan, thresholdsOfAnotherMetricAreErrors) {
    const auto small = fiveSpheres();
    RenderSettings settings = settingsFor(16);
    settings.metric = LodMetric::measured;
    EXPECT_THROW(planFrame(small->world, small->view, settings), Error);
    settings.thresholds = {};
    EXPECT_NO_THROW(planFrame(small->world, small->view, settings));
    settings.thresholds.light = 0.1;
    EXPECT_NO_THROW(planFrame(small->world, small->view, settings));
    settings.metric = LodMetric::size;
    EXPECT_THROW(planFrame(small->world, small->view, settings), Error);
}

TEST(FramePlan, aThresholdOfTheirSizeChoosesLevelsBySizeAndNoneTheMeasuredOnes) {
    const auto small = fiveSpheres();
    RenderSettings settings;
    const auto metricWith = [&](const GivenThresholds& given) {
        settings.thresholds = given;
        return planFrame(small->world, small->view, settings).settings.metric;
    };
    EXPECT_EQ(metricWith({}), LodMetric::measured);
    EXPECT_EQ(metricWith({.light = 0.1}), LodMetric::measured);
    EXPECT_EQ(metricWith({.blur = 0.1}), LodMetric::size);
    EXPECT_EQ(metricWith({.size = 2}), LodMetric::size);
    EXPECT_THROW(metricWith({.size = 2, .light = 0.1}), Error);
    settings.metric = LodMetric::error;
    EXPECT_EQ(metricWith({.size = 2}), LodMetric::error);
}

// Levels of detail chosen by blur alone or by projected size alone are at most as coarse as levels chosen by both. A
// pinhole has no blur: selection by both then equals selection by size, and selection by blur alone gives full detail.
TEST(FramePlan, levelsByOneCauseAloneAreFiner) {
    const auto small = fiveSpheres();
    for (const LodMetric metric : {LodMetric::size, LodMetric::error, LodMetric::measured}) {
        RenderSettings settings{.metric = metric};
        const auto lambdas = [&](LodCause cause) {
            settings.lodCause = cause;
            std::map<int, double> result;
            for (const ObjectPlan& object : planFrame(small->world, small->view, settings).objects)
                result[object.object] = object.lambda;
            return result;
        };
        small->view.lens.dofEnabled = true;
        const auto both = lambdas(LodCause::blurAndSize);
        const auto bySize = lambdas(LodCause::size);
        const auto byBlur = lambdas(LodCause::blur);
        double finer = 0;
        for (const auto& [object, lambda] : both) {
            EXPECT_LE(bySize.at(object), lambda) << lodMetricName(metric) << ' ' << object;
            EXPECT_LE(byBlur.at(object), lambda) << lodMetricName(metric) << ' ' << object;
            finer += lambda - byBlur.at(object);
        }
        EXPECT_GT(finer, 0) << lodMetricName(metric);
        small->view.lens.dofEnabled = false;
        EXPECT_EQ(lambdas(LodCause::blurAndSize), lambdas(LodCause::size)) << lodMetricName(metric);
        for (const auto& [object, lambda] : lambdas(LodCause::blur))
            EXPECT_EQ(lambda, 0) << lodMetricName(metric) << ' ' << object;
    }
}

TEST(FramePlan, impossibleRequestsAreErrors) {
    const auto small = fiveSpheres();
    EXPECT_THROW(planFrame(small->world, small->view, settingsFor(0)), Error);
    EXPECT_THROW(planFrame(small->world, small->view, settingsFor(10'000'000)), Error);
    View view = small->view;
    view.width = 0;
    EXPECT_THROW(planFrame(small->world, view, settingsFor(1)), Error);
    view = small->view;
    view.lens.focusDistance = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(planFrame(small->world, view, settingsFor(1)), Error);
}

TEST(FramePlan, tableNamesObjectsAndReasons) {
    const auto small = fiveSpheres();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const std::string table = planTable(plan);
    EXPECT_NE(table.find(plan.objects[0].name), std::string::npos);
    EXPECT_NE(table.find("it is outside the image for all lens samples"), std::string::npos);
}

// A strongly curved focus surface would divide each of 80,000 triangles into thousands of parts. One bound on the
// number of parts applies to all objects of a frame.
TEST(PlanFrame, divisionsOfAFrameAreBounded) {
    const auto parts = [](int slices, double curvature) {
        SmallWorld small;
        small.scene.materials.push_back(unlitMaterial(glm::vec4(1)));
        small.scene.meshes = {bumpySphere(slices, slices, 0), quad(0)};
        place(small, 0, glm::translate(glm::dmat4(1), {0, 0, -4}));
        place(small, 1, glm::translate(glm::dmat4(1), {0, 0, -8}));
        for (const Mesh& mesh : small.scene.meshes) small.world.pyramids.push_back(fullDetail(mesh));
        small.view.lens.focusDistance = 2;
        small.view.lens.fStop = 1;
        small.view.lens.fieldCurvature = curvature;
        const RenderSettings settings{.lod = LodMode::off};
        const FramePlan plan = planFrame(small.world, small.view, settings);
        EXPECT_EQ(plan.objects.at(0).maxParts, plan.objects.at(1).maxParts);
        EXPECT_EQ(plan.objects.at(0).refinement, Refinement::subdivide);
        return plan.objects.at(0).maxParts;
    };
    EXPECT_EQ(parts(10, 1000), maxEdgeParts);
    const std::uint32_t bounded = parts(200, 1000);
    EXPECT_LT(bounded, maxEdgeParts);
    EXPECT_LE(80'000.0 * bounded * bounded, 4e6 * 4);
}

}  // namespace
}  // namespace defocus::engine
