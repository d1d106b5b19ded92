// Tests lens samples that are split: some pixels show one level of detail of an object, and the others the next level
// (LodMode::continuous). The tests check which pixels, and how many, show the next level, and how much a split changes
// the image.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "likeness.h"
#include "render/accumulation/accumulated.h"

namespace defocus::engine {
namespace {

// Plans the only object at level `level` + 1 in the first `coarseCount` samples and at `level` in the later samples.
// The first of the later samples is split: a fraction `share` of its pixels shows level `level` + 1.
void setSplit(FramePlan& plan, const World& world, std::uint32_t level, std::uint32_t coarseCount, double share) {
    ObjectPlan& object = plan.objects.at(0);
    const auto samples = static_cast<std::uint32_t>(plan.samples.size());
    const auto triangles = [&](std::uint32_t l) { return world.pyramids[0].levels.at(l).triangleCount; };
    object.coarse = {level + 1, 0, coarseCount + (share > 0 ? 1 : 0), triangles(level + 1)};
    object.fine = {level, coarseCount, samples - coarseCount, triangles(level)};
    object.boundaryShare = share;
    plan.levelsUsed[0].assign(plan.levelsUsed[0].size(), true);
}

// Returns a scene that contains only the nearest of the five spheres, enlarged.
std::unique_ptr<SmallWorld> oneSphere() {
    auto small = fiveSpheres();
    small->world.pose.objects.resize(1);
    small->world.pose.objects[0].worldFromObject =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -1.5)), glm::dvec3(0.35));
    return small;
}

// If a sample is split between two levels of detail, each pixel is bit-identical to the same pixel of one of two images
// without a split. In one image, this sample shows the finer level; in the other, it shows the coarser level.
TEST_F(ScreenDoor, pixelsAreThoseOfOneSplitOrTheOther) {
    const auto small = oneSphere();
    constexpr std::uint32_t samples = 8;
    const auto split = [&](std::uint32_t coarseCount) {
        FramePlan plan = planFrame(small->world, small->view, continuousFor(samples));
        setSplit(plan, small->world, 2, coarseCount, 0);
        return renderedPlan(*small, plan);
    };
    const Image n = split(3);
    const Image more = split(4);
    std::vector<bool> coarseBefore(n.pixels.size() / 4, false);
    for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9}) {
        FramePlan plan = planFrame(small->world, small->view, continuousFor(samples));
        setSplit(plan, small->world, 2, 3, share);
        const Image image = renderedPlan(*small, plan);
        int differing = 0;
        int coarse = 0;
        for (std::size_t i = 0; i < image.pixels.size() / 4; ++i) {
            const auto same = [&](const Image& a, const Image& b) {
                return std::memcmp(a.pixels.data() + 4 * i, b.pixels.data() + 4 * i, 4 * sizeof(float)) == 0;
            };
            ASSERT_TRUE(same(image, n) || same(image, more)) << "pixel " << i << " at " << share;
            if (same(n, more)) continue;
            ++differing;
            coarse += same(image, more) ? 1 : 0;
            ASSERT_TRUE(same(image, more) || !coarseBefore[i]) << "a coarse pixel stays coarse";
            coarseBefore[i] = same(image, more);
        }
        ASSERT_GT(differing, 1000);
        EXPECT_NEAR(static_cast<double>(coarse) / differing, share, 0.02);
    }
}

// Splitting a sample between two levels of detail changes the coverage of a pixel by at most one sample. With N
// samples, no pixel changes by more than 1/N of the colour difference between object and background.
TEST_F(ScreenDoor, costsNoMoreThanASampleOfCoverage) {
    const auto small = oneSphere();
    small->scene.materials[0] = unlitMaterial({1, 1, 1, 1});
    small->scene.meshes[0].vertices.colors.clear();
    finish(*small);
    small->world.environment = {EnvironmentType::uniform, {0, 0, 0}, {}, {}, nullptr, 1};
    for (const std::uint32_t samples : {1u, 8u, 32u}) {
        FramePlan plan = planFrame(small->world, small->view, continuousFor(samples));
        // The outlines of the two coarsest levels differ more than those of any other successive levels.
        const auto last = static_cast<std::uint32_t>(small->world.pyramids[0].levels.size() - 2);
        setSplit(plan, small->world, last, samples / 2, 0);
        const Image full = renderedPlan(*small, plan);
        setSplit(plan, small->world, last, samples / 2, 0.5);
        const double largest = largestDifference(full, renderedPlan(*small, plan));
        EXPECT_LE(largest, 1.0 / samples + 1e-6);
        EXPECT_GT(largest, 0.9 / samples) << "the outlines must differ";
    }
}

// A small change in the level of detail λ changes few pixels, and each of them by one sample. If λ changes by δ, the
// expected fraction of changed pixels is at most δ times the number of samples. The test allows twice this fraction.
TEST_F(ScreenDoor, changesLittleWithLambda) {
    const auto small = oneSphere();
    constexpr std::uint32_t samples = 16;
    const auto at = [&](double lambda) {
        FramePlan plan = planFrame(small->world, small->view, continuousFor(samples));
        const SampleSplit split = splitSamples(lambda, samples, LodMode::continuous);
        setSplit(plan, small->world, split.level, split.coarseCount, split.boundaryShare);
        return renderedPlan(*small, plan);
    };
    const double pixels = 160.0 * 120;
    // at all of these values except 1.03, no sample is split between levels
    for (const double lambda : {1.0, 1.03, 1 + 5.0 / samples, 1.5, 2.0}) {
        const Image below = at(lambda - 1e-4);
        const Image above = at(lambda + 1e-4);
        int changed = 0;
        for (std::size_t i = 0; i < below.pixels.size() / 4; ++i)
            changed += std::memcmp(below.pixels.data() + 4 * i, above.pixels.data() + 4 * i, 4 * sizeof(float)) != 0;
        EXPECT_LE(changed, 2 * 2e-4 * samples * pixels + 8) << lambda;
        EXPECT_LE(largestDifference(below, above), 2.0 / samples);  // a sample's radiance is at most 2
    }
}

TEST_F(ScreenDoor, ofBlendedSurfacesLeavesNoHole) {
    const auto small = oneSphere();
    small->scene.materials[0] = unlitMaterial({0.2f, 0.6f, 1, 0.5f});
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.meshes[0].vertices.colors.clear();
    finish(*small);
    small->world.environment = {EnvironmentType::uniform, {1, 0, 0}, {}, {}, nullptr, 1};
    FramePlan plan = planFrame(small->world, small->view, continuousFor(1));
    plan.blendOrder.at(0).stochastic = false;  // draw sorted; stochastic transparency leaves holes in a single sample
    setSplit(plan, small->world, 1, 0, 0.4);
    const Image image = renderedPlan(*small, plan);
    EXPECT_NEAR(image.at(80, 60)[0], 0.6, 2e-3);  // half the sphere's colour and half the background's in each pixel
    for (int y = 50; y < 70; ++y)
        for (int x = 70; x < 90; ++x)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(x, y)[c], image.at(80, 60)[c], 2e-3) << x << ' ' << y;
}

}  // namespace
}  // namespace defocus::engine
