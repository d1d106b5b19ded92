#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/speedup.h"
#include "eval/speedup_text.h"
#include "gl/context.h"
#include "small_world.h"

namespace defocus {
namespace {

TEST(Speedup, measuresEachModeOfEachSettingAgainstTheSameFullDetail) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {4, 9};
    options.fStops = {small->view.lens.fStop * 2};
    options.sweepSamples = 5;
    options.runs = 2;
    options.referenceSamples = 16;
    std::vector<SpeedupRow> rows;
    measureSpeedup(small->world, small->view, options, [&](const SpeedupRow& row) { rows.push_back(row); });

    ASSERT_EQ(rows.size(), 9u);  // 3 settings, 3 modes
    const std::uint32_t samples[3] = {4, 9, 5};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const SpeedupRow& row = rows[i];
        const SpeedupRow& full = rows[i / 3 * 3];
        EXPECT_EQ(row.samples, samples[i / 3]);
        EXPECT_EQ(row.sweep, i < 6 ? "samples" : "aperture");
        EXPECT_EQ(full.mode, LodMode::off);
        EXPECT_EQ(full.fromFullDetail.rmse, 0);
        EXPECT_DOUBLE_EQ(full.speedUp, 1);
        EXPECT_DOUBLE_EQ(row.speedUp, full.milliseconds.median / row.milliseconds.median);
        EXPECT_LE(row.milliseconds.low, row.milliseconds.median);
        EXPECT_LE(row.milliseconds.median, row.milliseconds.high);
        EXPECT_LE(row.triangles, full.triangles);
        // The reference has the view's own lens.
        ASSERT_EQ(row.fromReference.has_value(), i < 6);
        if (row.fromReference) {
            EXPECT_GT(row.fromReference->rmse, 0);
        }
    }
    EXPECT_LT(rows[1].triangles, rows[0].triangles);
    // Which clusters face away from all samples depends on where on the lens they are: not quite in proportion.
    const double ofOneSample = static_cast<double>(rows[0].triangles) / 4;
    EXPECT_NEAR(static_cast<double>(rows[3].triangles) / 9, ofOneSample, 0.01 * ofOneSample);

    // Both files hold every row.
    const std::string csv = speedupCsv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);
    EXPECT_EQ(nlohmann::json::parse(speedupJson(rows, {}))["rows"].size(), 9u);
}

}  // namespace
}  // namespace defocus
