#include "plan/sample_range.h"

#include <gtest/gtest.h>

#include "small_world.h"

namespace defocus::engine {
namespace {

// The levels of detail that show an object in one lens sample. If there are two levels, `share` is the fraction of
// pixels that show the coarser level; otherwise it is 0.
struct Drawn {
    std::vector<std::uint32_t> levels;
    double share = 0;
    bool operator==(const Drawn&) const = default;
};

Drawn drawnAt(const ObjectPlan& object, std::uint32_t sample) {
    Drawn drawn;
    for (const LevelDraw& draw : {object.coarse, object.fine})
        if (sample >= draw.firstSample && sample < draw.firstSample + draw.sampleCount)
            drawn.levels.push_back(draw.level);
    if (boundarySample(object) == sample) drawn.share = object.boundaryShare;
    return drawn;
}

TEST(SampleRange, eachSampleIsDrawnAsInTheWholeFrame) {
    const auto small = fiveSpheres();
    for (const LodMode mode : {LodMode::fractional, LodMode::continuous, LodMode::nearest, LodMode::off}) {
        const RenderSettings settings{.sampleCount = 150, .seed = 5, .lod = mode, .thresholds = {0.5, 2}};
        const FramePlan full = planFrame(small->world, small->view, settings);
        std::uint64_t triangles = 0;
        for (const auto& [first, count] : {std::pair(0u, 64u), std::pair(64u, 64u), std::pair(128u, 22u)}) {
            const FramePlan part = samplesOf(full, first, count);
            ASSERT_EQ(part.samples.size(), count);
            ASSERT_EQ(part.objects.size(), full.objects.size());
            EXPECT_EQ(part.settings.firstSample, first);
            triangles += part.trianglesDrawn;
            for (std::uint32_t i = 0; i < count; ++i) {
                EXPECT_EQ(part.samples[i].lens, full.samples[first + i].lens);
                for (std::size_t o = 0; o < full.objects.size(); ++o)
                    EXPECT_EQ(drawnAt(part.objects[o], i), drawnAt(full.objects[o], first + i))
                        << o << ' ' << first + i;
            }
        }
        EXPECT_EQ(triangles, full.trianglesDrawn);
    }
}

}  // namespace
}  // namespace defocus::engine
