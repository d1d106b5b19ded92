#include "plan/tiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plan/plan_checks.h"
#include "small_world.h"

namespace defocus {
namespace {

RatedBlock firstBlock(const FramePlan& plan) {
    return ratedBlock(plan, frameRates(plan), 0, 64);
}

// Wherever a lens sample and a pixel offset bring a vertex, and as far as its pixels reach, the tile has its layers.
TEST(Tiles, holdAllThatIsSeen) {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 0.3;
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const RatedBlock block = firstBlock(plan);
    const Tiles tiles = blockTiles(block);
    const double pixels = plan.view.width / (2 * plan.tanHalfHorizontal);
    std::size_t checked = 0;
    const auto check = [&](const FramePlan& part, TileLayers kind) {
        for (const ObjectPlan& object : part.objects)
            for (const glm::vec3& position : small->scene.meshes[0].vertices.positions) {
                const glm::dvec3 at = object.viewFromObject * glm::dvec4(position, 1);
                const double blur = std::abs(circleOfConfusion(plan.coc, -at.z, plan.view.width));
                const double reach = 0.5 * blur + 1.5 * part.pixelRate;
                for (double angle = 0; angle < 6.3; angle += 0.5) {
                    const double x = plan.view.width / 2.0 - at.x / at.z * pixels + reach * std::cos(angle);
                    const double y = plan.view.height / 2.0 - at.y / at.z * pixels + reach * std::sin(angle);
                    if (x < 0 || y < 0 || x >= plan.view.width || y >= plan.view.height) continue;
                    ASSERT_TRUE(tiles.at(static_cast<int>(x) / tileSide, static_cast<int>(y) / tileSide) & kind)
                        << object.name << ' ' << x << ' ' << y;
                    ++checked;
                }
            }
    };
    check(block.samples, 1);
    check(block.groups, 1);
    check(block.larger[0], 2);
    check(block.larger[1], 4);
    EXPECT_GT(checked, 1000u);
    EXPECT_FALSE(block.larger[0].objects.empty() && block.larger[1].objects.empty());
}

TEST(Tiles, areasOfAllKindsMakeTheImage) {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 0.3;
    small->view.width = 203;
    small->view.height = 117;
    const FramePlan plan = planFrame(small->world, small->view, settingsFor(64));
    const Tiles tiles = blockTiles(firstBlock(plan));
    std::vector<int> covered(203 * 117);
    for (TileLayers layers = 0; layers < tileKinds; ++layers)
        for (const PixelArea& area : tileAreas(tiles, layers, plan.view))
            for (int y = area.bottom; y < area.top; ++y)
                for (int x = area.left; x < area.right; ++x) ++covered[static_cast<std::size_t>(y * 203 + x)];
    for (const int times : covered) ASSERT_EQ(times, 1);
}

// With more samples, only more strongly blurred objects have larger pixels, and fewer of their samples.
TEST(Rates, largerPixelsGiveWayAsSamplesGrow) {
    const auto small = fiveSpheres();
    small->view.lens.fStop = 0.3;
    std::vector<double> before;
    double first = 0;
    for (const std::uint32_t samples : {64u, 256u, 1024u, 16384u}) {
        const FramePlan plan = planFrame(small->world, small->view, settingsFor(samples));
        std::vector<double> shares;
        for (const ObjectRates& rates : frameRates(plan).objects) {
            EXPECT_GE(rates.largerShares[0], rates.largerShares[1]);
            shares.push_back(rates.largerShares[0]);
            if (samples == 64) first += rates.largerShares[0];
        }
        for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(shares[i], before[i]);
        before = shares;
    }
    EXPECT_GT(first, 0);
    for (const double share : before) EXPECT_EQ(share, 0);
}

}  // namespace
}  // namespace defocus
