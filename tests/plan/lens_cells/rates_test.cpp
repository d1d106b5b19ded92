#include "plan/lens_cells/rates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "plan/plan_checks.h"
#include "plan/plan_text.h"
#include "plan/sample_range.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// Five spheres without a background, of which only some are blurred little enough to share.
std::unique_ptr<SmallWorld> hardlyBlurred() {
    auto small = fiveSpheres();
    small->view.lens.fStop = 1.1;
    // a transparent background rules out lens cells
    small->world.environment = {EnvironmentType::none, {}, {}, {}, nullptr, 1};
    return small;
}

RatedBlock blockOf(const FramePlan& plan, std::uint32_t first, std::uint32_t count) {
    return ratedBlock(plan, frameRates(plan, false), first, count);
}

// Adds the share of a sample's pixels that each object shows, by level.
using Shares = std::map<std::pair<int, std::uint32_t>, double>;

void addShares(Shares& shares, const FramePlan& plan, std::uint32_t sample, double weight = 1) {
    for (const ObjectPlan& object : plan.objects) {
        const bool divided = boundarySample(object) == sample;
        for (const LevelDraw* draw : {&object.coarse, &object.fine}) {
            if (sample < draw->firstSample || sample >= draw->firstSample + draw->sampleCount) continue;
            const double share = draw == &object.coarse ? object.boundaryShare : 1 - object.boundaryShare;
            shares[{object.object, draw->level}] += weight * (divided ? share : 1);
        }
    }
}

// Returns the shares in sample `sample` of the block: its group's image and its own objects.
Shares shownIn(const RatedBlock& block, std::uint32_t sample) {
    Shares shares;
    addShares(shares, block.samples, sample);
    addShares(shares, block.groups, sample / block.groupSize);
    return shares;
}

TEST(Rates, eachSampleShowsEachObjectOnceAndABlockShowsItsLevels) {
    const auto small = fiveSpheres();
    const auto check = [&](const FramePlan& plan) {
        const auto total = static_cast<std::uint32_t>(plan.samples.size());
        for (std::uint32_t first = 0; first < total; first += rateBlock) {
            const std::uint32_t count = std::min(rateBlock, total - first);
            const RatedBlock block = blockOf(plan, first, count);
            Shares expected;
            Shares shown;
            for (std::uint32_t i = 0; i < count; ++i) {
                addShares(expected, plan, first + i);
                std::map<int, double> objects;
                for (const auto& [key, share] : shownIn(block, i)) {
                    objects[key.first] += share;
                    shown[key] += share;
                }
                ASSERT_EQ(objects.size(), plan.objects.size());
                for (const auto& [object, share] : objects) ASSERT_NEAR(share, 1, 1e-9) << object << ' ' << first + i;
            }
            // In an incomplete group at the end of a frame, all samples show the group's image.
            const double slack = count % block.groupSize == 0 ? 1e-9 : block.groupSize;
            for (const auto& [key, share] : expected) EXPECT_NEAR(shown[key], share, slack) << key.first;
        }
    };
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous, LodMode::nearest, LodMode::off})
        for (const std::uint32_t count : {16u, 33u, 64u, 150u})
            for (double fStop = 1; fStop < 12; fStop *= 1.3) {
                small->view.lens.fStop = fStop;
                RenderSettings settings = settingsFor(count);
                settings.lod = mode;
                check(planFrame(small->world, small->view, settings));
            }
}

// Samples of a group have the pixel offset of its image. Where a shared object covers an unshared one, only the lens
// points differ.
TEST(Rates, allOfAGroupHasItsImagesPixelOffset) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const RatedBlock block = blockOf(plan, 0, 64);
    std::set<std::pair<float, float>> offsets;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::vec2 pixel = block.samples.samples[i].pixel;
        EXPECT_EQ(pixel, block.groups.samples[i / 4].pixel);
        offsets.emplace(pixel.x, pixel.y);
    }
    EXPECT_EQ(offsets.size(), minLensGroups);
}

TEST(Rates, onlyWhatIsHardlyBlurredShares) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const RatedBlock block = blockOf(plan, 0, 64);
    std::size_t sharing = 0;
    for (const ObjectPlan& object : plan.objects) {
        const bool shares = std::ranges::any_of(block.groups.objects,
                                                [&](const ObjectPlan& group) { return group.object == object.object; });
        EXPECT_EQ(shares, object.coc.largest < minShareBlur - 0.1) << object.coc.largest;
        sharing += shares ? 1 : 0;
    }
    EXPECT_GE(sharing, 1u);
    EXPECT_LT(sharing, plan.objects.size());
    EXPECT_LT(ratedTriangles(plan, frameRates(plan, false)), plan.trianglesDrawn);
}

// Objects shared by all groups are drawn as in a frame with a quarter of the samples.
TEST(Rates, theImagesAreTheFirstSamplesOfTheSequence) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(128));
    for (const std::uint32_t first : {0u, 64u}) {
        const RatedBlock block = blockOf(plan, first, 64);
        ASSERT_EQ(block.groups.samples.size(), 16u);
        for (std::uint32_t g = 0; g < 16; ++g) {
            EXPECT_EQ(block.groups.samples[g].lens, plan.samples[first / 4 + g].lens);
            EXPECT_EQ(block.groups.samples[g].pixel, plan.samples[first / 4 + g].pixel);
        }
    }
}

TEST(Rates, theShareFollowsTheBlurWithoutJumps) {
    const auto small = fiveSpheres();
    std::map<int, double> before;
    double largestStep = 0;
    bool between = false;
    for (double blur = 0; blur <= 1; blur += 0.002) {
        small->view.lens.blurScale = blur;
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
        if (!plan.usesLens) continue;
        const FrameRates rates = frameRates(plan, false);
        for (std::size_t i = 0; i < plan.objects.size(); ++i) {
            const ObjectPlan& object = plan.objects[i];
            const double share = rates.objects[i].lensShare;
            between = between || (share > 0 && share < 1);
            const auto [entry, isNew] = before.try_emplace(object.object, share);
            largestStep = std::max(largestStep, std::abs(share - entry->second));
            entry->second = share;
        }
    }
    EXPECT_TRUE(between);
    // 0.002 of the nearest sphere's blur of 20 px is 0.04 px. The share falls from 1 to 0 over 1.5 px.
    EXPECT_LT(largestStep, 0.1);
}

// The shared areas contain every position that a lens sample and a pixel offset can give a vertex.
TEST(Rates, groupsShowNothingOutsideTheSharedAreas) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const RatedBlock block = blockOf(plan, 0, 64);
    ASSERT_FALSE(block.sharedAreas.empty());
    const auto covered = [&](double x, double y) {
        return std::ranges::any_of(block.sharedAreas, [&](const PixelArea& area) {
            return x >= area.left && x < area.right && y >= area.bottom && y < area.top;
        });
    };
    for (const ObjectPlan& object : block.groups.objects)
        for (const glm::vec3& position : small->scene.meshes[0].vertices.positions) {
            const glm::dvec3 at = object.viewFromObject * glm::dvec4(position, 1);
            const double pixels = plan.view.width / (2 * plan.tanHalfHorizontal);
            const double blur =
                plan.apertureDiameter * std::abs(1 / small->view.lens.focusDistance + 1 / at.z) * pixels;
            for (double angle = 0; angle < 6.3; angle += 0.5) {
                const double x = plan.view.width / 2.0 - at.x / at.z * pixels + blur / 2 * std::cos(angle);
                const double y = plan.view.height / 2.0 - at.y / at.z * pixels + blur / 2 * std::sin(angle);
                const bool inside = x > 1 && x < plan.view.width - 1 && y > 1 && y < plan.view.height - 1;
                for (const double offset : {-0.5, 0.5})
                    ASSERT_TRUE(!inside || covered(x + offset, y + offset)) << x << ' ' << y;
            }
        }
}

// Blocks of different machines, and blocks planned one after another, divide the groups as a single plan of the frame
// does.
TEST(Rates, blocksOfAPartShareAsInTheWholeFrame) {
    auto small = fiveSpheres();
    // Searches an f-stop with a fractional share.
    for (double f = 1; f < 20; f *= 1.02) {
        small->view.lens.fStop = f;
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(192));
        const FrameRates rates = frameRates(plan, false);
        const bool partly = std::ranges::any_of(
            rates.objects, [&](const ObjectRates& object) { return object.lensShare > 0.3 && object.lensShare < 0.7; });
        if (!partly) continue;
        const FramePlan part = samplesOf(plan, 64, 128);
        for (const std::uint32_t first : {64u, 128u}) {
            const RatedBlock full = blockOf(plan, first, 64);
            const RatedBlock ofPart = blockOf(part, first - 64, 64);
            EXPECT_EQ(full.groupsShare, ofPart.groupsShare);
            EXPECT_EQ(full.samples.trianglesDrawn, ofPart.samples.trianglesDrawn);
            EXPECT_EQ(full.groups.trianglesDrawn, ofPart.groups.trianglesDrawn);
            for (std::size_t i = 0; i < 64; ++i)
                EXPECT_EQ(full.samples.samples[i].lens, ofPart.samples.samples[i].lens);
        }
        return;
    }
    FAIL() << "no object has a fractional share";
}

TEST(Rates, aFewSamplesKeepTheirPixelOffsets) {
    EXPECT_EQ(groupSamples(64), 4u);
    EXPECT_EQ(groupSamples(48), 3u);
    EXPECT_EQ(groupSamples(32), 2u);
    for (const std::uint32_t count : {1u, 8u, 31u}) EXPECT_EQ(groupSamples(count), 1u);
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(31));
    const RatedBlock block = blockOf(plan, 0, 31);
    EXPECT_TRUE(block.groups.samples.empty());
    EXPECT_EQ(ratedTriangles(plan, frameRates(plan, false)), plan.trianglesDrawn);
}

TEST(Rates, keepAllSharesNothing) {
    const auto small = hardlyBlurred();
    RenderSettings settings = settingsFor(64);
    settings.keepAll = true;
    const FramePlan plan = planFrame(small->world, small->view, settings);
    const RatedBlock block = blockOf(plan, 0, 64);
    EXPECT_EQ(block.groupsShare, 0u);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(block.samples.samples[i].lens, plan.samples[i].lens);
    EXPECT_EQ(ratedTriangles(plan, frameRates(plan, false)), plan.trianglesDrawn);
}

// Objects that differ between the samples of a group are drawn for each sample.
TEST(Rates, whatDiffersFromSampleToSampleIsNotShared) {
    const auto small = hardlyBlurred();
    const auto reasons = [&] {
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
        EXPECT_EQ(blockOf(plan, 0, 64).groups.objects.size(), 0u);
        const FrameRates rates = frameRates(plan, false);
        std::string all;
        for (const ObjectRates& object : rates.objects) all += object.reason + "\n";
        return all;
    };
    small->view.lens.axialChromaticAberration = 0.3;
    EXPECT_NE(reasons().find("wavelength"), std::string::npos);
    small->view.lens.axialChromaticAberration = 0;
    small->view.shutterCameras.assign(2, small->view.worldFromCamera);
    small->view.shutterCameras[1] = glm::translate(small->view.worldFromCamera, glm::dvec3(0, 0, 0.25));
    EXPECT_NE(reasons().find("moves"), std::string::npos);
    small->view.shutterCameras.clear();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    EXPECT_NE(reasons().find("blended"), std::string::npos);
}

FramePlan fiveSpheresPlan() {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 1.1;
    return planFrame(small->world, small->view, settingsFor(64));
}

TEST(Rates, thePlanIsPrintedWithThem) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const nlohmann::json json = nlohmann::json::parse(planJson(plan));
    EXPECT_EQ(json["triangles"]["multirate"], ratedTriangles(plan, frameRates(plan)));
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        EXPECT_EQ(json["objects"][i]["rates"]["lensShare"], frameRates(plan).objects[i].lensShare);
    EXPECT_NE(planTable(fiveSpheresPlan()).find("--method multirate blurs each sample's image"), std::string::npos);
}

// Sharing errs more than drawing each sample, so a frame without lens cells uses the accumulation's samples.
TEST(Rates, withoutCellsNothingSharesUnlessItIsAskedFor) {
    const auto small = hardlyBlurred();
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const auto shared = frameRates(plan, false).objects;
    ASSERT_TRUE(std::ranges::any_of(shared, [](const ObjectRates& object) { return object.lensShare > 0; }));
    const FrameRates rates = frameRates(plan);
    ASSERT_EQ(rates.cells.blur, 0);
    for (const ObjectRates& object : rates.objects) EXPECT_EQ(object.lensShare, 0);
    const RatedBlock block = ratedBlock(plan, rates, 0, 64);
    EXPECT_TRUE(block.groups.samples.empty() && block.groupsShare == 0);
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(block.samples.samples[i].lens, plan.samples[i].lens);
        EXPECT_EQ(block.samples.samples[i].pixel, plan.samples[i].pixel);
    }
    EXPECT_NE(planTable(plan).find("draws this frame as the accumulation does: the background is transparent"),
              std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
