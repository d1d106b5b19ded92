#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/speedup/speedup.h"
#include "eval/speedup/text.h"
#include "frame/reference_image.h"
#include "gl/context.h"
#include "small_world.h"

namespace defocus {
namespace {

TEST(Speedup, measuresEachModeOfEachSettingAgainstTheSameFullDetail) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {4, 9};
    options.fStops = {small->view.lens.fStop * 8};
    options.sweepSamples = 5;
    options.runs = 2;
    options.pyramidMilliseconds = 12;
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
        EXPECT_EQ(row.runs, 2);
        EXPECT_GT(row.setupMilliseconds, 0);
        EXPECT_EQ(row.pyramidMilliseconds, row.mode == LodMode::off ? 0 : 12);
        // The reference has the row's lens, and eight times the most samples that are measured with it.
        ASSERT_TRUE(row.fromReference);
        EXPECT_GT(row.fromReference->rmse, 0);
        EXPECT_EQ(row.referenceSamples, i < 6 ? 72u : 40u);
        EXPECT_GT(row.referenceRemaining.rmse, 0);
    }
    EXPECT_LT(rows[1].triangles, rows[0].triangles);
    // Which clusters face away from all samples depends on where on the lens they are: not quite in proportion.
    const double ofOneSample = static_cast<double>(rows[0].triangles) / 4;
    EXPECT_NEAR(static_cast<double>(rows[3].triangles) / 9, ofOneSample, 0.01 * ofOneSample);

    // Another lens than the row's would be farther off than too few samples are.
    View wide = small->view;
    View narrow = small->view;
    narrow.lens.fStop *= 8;
    const Image wideImage = renderedReference(small->world, wide, {72, {}}).image;
    const Image narrowImage = renderedReference(small->world, narrow, {40, {}}).image;
    const double apart = compareImages(wideImage, narrowImage).rmse;
    EXPECT_LT(rows[3].fromReference->rmse, apart / 2);
    EXPECT_LT(rows[6].fromReference->rmse, apart / 2);

    // Both files hold every row.
    const std::string csv = speedupCsv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 10 * commas);
    const nlohmann::json json = nlohmann::json::parse(speedupJson(rows, {}))["rows"];
    EXPECT_EQ(json.size(), 9u);
    EXPECT_EQ(json[8]["pyramidMilliseconds"], 12);
    EXPECT_EQ(json[8]["referenceSamples"], 40);
}

TEST(Speedup, hasNoReferenceWhereNoneIsWanted) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {2};
    options.runs = 1;
    options.referenceSamples = 0;
    measureSpeedup(small->world, small->view, options, [](const SpeedupRow& row) {
        EXPECT_FALSE(row.fromReference);
        EXPECT_EQ(row.referenceSamples, 0u);
    });
}

}  // namespace
}  // namespace defocus
