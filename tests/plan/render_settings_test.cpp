#include "plan/render_settings.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

TEST(RenderSettings, fixedThresholdsDoNotFollowTheSamples) {
    const auto light = [](std::uint32_t samples) { return defaultThresholds(LodMetric::measured, samples).light; };
    RenderSettings fixed;
    fixThresholds(fixed, 64, 2);
    EXPECT_EQ(fixed.metric, LodMetric::measured);
    EXPECT_FALSE(fixed.thresholds.blur || fixed.thresholds.size);
    EXPECT_EQ(chosenThresholds(fixed.thresholds, LodMetric::measured, 7).light, 2 * light(64));
}

}  // namespace
}  // namespace defocus::engine
