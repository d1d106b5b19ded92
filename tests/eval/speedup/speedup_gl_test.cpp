#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eval/speedup/speedup.h"
#include "eval/speedup/text.h"
#include "frame/driver/reference_image.h"
#include "gl/context.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

TEST(Speedup, measuresEachModeOfEachSettingAgainstTheSameFullDetail) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {4, 9};
    options.fStops = {small->view.lens.fStop * 8};
    options.sweepSamples = 5;
    options.runs = 2;
    const std::vector<SpeedupForm> forms = {{"", &small->world, {}, 12}};
    std::vector<SpeedupRow> rows;
    measureSpeedup(forms, small->view, options, [&](const SpeedupRow& row) { rows.push_back(row); });

    ASSERT_EQ(rows.size(), 9u);  // (2 sample counts of one lens + 1 of the other) × 3 level modes
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
        // Each row is compared with a reference image of the same lens. The reference has eight times as many samples
        // as the measured image with the most samples: 8 · 9 = 72 for the first lens and 8 · 5 = 40 for the second.
        ASSERT_TRUE(row.fromReference);
        EXPECT_GT(row.fromReference->rmse, 0);
        EXPECT_EQ(row.referenceSamples, i < 6 ? 72u : 40u);
        EXPECT_GT(row.referenceRemaining.rmse, 0);
        // Two runs use two seeds. The images of the seeds have different errors, and the reported error averages both.
        ASSERT_EQ(row.ofSeeds.size(), 2u);
        const double first = row.ofSeeds[0].rmse, second = row.ofSeeds[1].rmse;
        EXPECT_NE(first, second);
        EXPECT_NEAR(row.fromReference->rmse, std::sqrt((first * first + second * second) / 2), 1e-12);
        EXPECT_NEAR(row.fromReference->flip, (row.ofSeeds[0].flip + row.ofSeeds[1].flip) / 2, 1e-12);
    }
    EXPECT_LT(rows[1].triangles, rows[0].triangles);
    // The set of culled clusters depends on the lens samples, so the number of triangles is not quite proportional to
    // the number of samples.
    const double ofOneSample = static_cast<double>(rows[0].triangles) / 4;
    EXPECT_NEAR(static_cast<double>(rows[3].triangles) / 9, ofOneSample, 0.01 * ofOneSample);

    // Errors are smaller than half the difference between the images of the two lenses. This shows that each row of the
    // results was compared with a reference image for its own lens.
    View wide = small->view;
    View narrow = small->view;
    narrow.lens.fStop *= 8;
    const Image wideImage = renderedReference(small->world, wide, {72, {}}).image;
    const Image narrowImage = renderedReference(small->world, narrow, {40, {}}).image;
    const double apart = compareImages(wideImage, narrowImage).rmse;
    EXPECT_LT(rows[3].fromReference->rmse, apart / 2);
    EXPECT_LT(rows[6].fromReference->rmse, apart / 2);

    // The CSV and JSON files contain every row.
    const std::string csv = speedupCsv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 10 * commas);
    const nlohmann::json json = nlohmann::json::parse(speedupJson(rows, {}))["rows"];
    EXPECT_EQ(json.size(), 9u);
    EXPECT_EQ(json[8]["pyramidMilliseconds"], 12);
    EXPECT_EQ(json[8]["referenceSamples"], 40);
    EXPECT_EQ(json[0]["errorsOverSeeds"]["seeds"], 2);
    EXPECT_LT(json[0]["errorsOverSeeds"]["rmse"]["low"], json[0]["errorsOverSeeds"]["rmse"]["high"]);
}

TEST(Speedup, hasNoReferenceWhereNoneIsWanted) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {2};
    options.runs = 1;
    options.referenceSamples = 0;
    const std::vector<SpeedupForm> forms = {{"", &small->world, {}, 0}};
    measureSpeedup(forms, small->view, options, [](const SpeedupRow& row) {
        EXPECT_FALSE(row.fromReference);
        EXPECT_EQ(row.referenceSamples, 0u);
    });
}

// With only the size threshold or only the blur threshold, a frame draws more triangles than with both. Each of the two
// counts equals the count of a plan in which the other threshold is 0.
TEST(Speedup, tellsApartWhatSizeAndBlurContribute) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    SpeedupOptions options;
    options.sampleCounts = {8};
    options.runs = 1;
    options.referenceSamples = 0;
    // The blur threshold (2 px) coarsens the blurred spheres, and the size threshold (3 px) the spheres in focus.
    const RenderSettings plan{.thresholds = {2, 3}};
    const std::vector<SpeedupForm> forms = {{"", &small->world, plan, 0}};
    std::vector<SpeedupRow> rows;
    measureSpeedup(forms, small->view, options, [&](const SpeedupRow& row) { rows.push_back(row); });
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_FALSE(rows[0].sizeOnly);
    EXPECT_FALSE(rows[1].blurOnly);
    ASSERT_TRUE(rows[2].sizeOnly && rows[2].blurOnly);
    const auto planned = [&](double blur, double size) {
        const RenderSettings settings{.sampleCount = 8, .thresholds = {blur, size}};
        return planFrame(small->world, small->view, settings).trianglesDrawn;
    };
    EXPECT_EQ(rows[2].triangles, planned(2, 3));
    EXPECT_EQ(rows[2].sizeOnly->triangles, planned(0, 3));
    EXPECT_EQ(rows[2].blurOnly->triangles, planned(2, 0));
    EXPECT_LT(rows[2].triangles, rows[2].sizeOnly->triangles);
    EXPECT_LT(rows[2].triangles, rows[2].blurOnly->triangles);
    EXPECT_LT(rows[2].blurOnly->triangles, rows[0].triangles);
    EXPECT_GT(rows[2].sizeOnly->fromFullDetail.psnr, rows[2].fromFullDetail.psnr);

    const std::string header = speedupHeader();
    EXPECT_NE(header.find("size"), std::string::npos);
    EXPECT_EQ(speedupLine(rows[2]).find("nan"), std::string::npos);
    const nlohmann::json json = nlohmann::json::parse(speedupJson(rows, {}))["rows"];
    EXPECT_TRUE(json[0]["sizeOnly"].is_null());
    EXPECT_EQ(json[2]["sizeOnly"]["triangles"], rows[2].sizeOnly->triangles);
    EXPECT_EQ(json[2]["blurOnly"]["triangles"], rows[2].blurOnly->triangles);
}

// The published and the default settings of a method are each compared with full detail at the same number of samples.
// The two sets of settings use different sample sequences.
TEST(Speedup, measuresFormsAndMethodsBesideEachOther) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    World published = small->world;
    PyramidOptions surviving;
    surviving.vertices = LevelVertices::surviving;
    published.pyramids = buildPyramids(small->scene.meshes, surviving);
    RenderSettings halton;
    halton.sequence = Sequence::halton;
    SpeedupOptions options;
    options.sampleCounts = {4};
    options.runs = 1;
    options.referenceSamples = 0;
    options.methods = {parseMethodUse("circular:far-components=2,resolution=half")};
    const std::vector<SpeedupForm> forms = {{"published", &published, halton, 5}, {"", &small->world, {}, 7}};
    std::vector<SpeedupRow> rows;
    measureSpeedup(forms, small->view, options, [&](const SpeedupRow& row) { rows.push_back(row); });
    ASSERT_EQ(rows.size(), 7u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(rows[i].preset, i < 3 ? "published" : "");
        EXPECT_EQ(rows[i].method, "accumulation");
        EXPECT_EQ(rows[i].speedUp, rows[i / 3 * 3].milliseconds.median / rows[i].milliseconds.median);
    }
    EXPECT_EQ(rows[0].fromFullDetail.rmse, 0);
    EXPECT_EQ(rows[3].fromFullDetail.rmse, 0);
    EXPECT_NE(rows[2].fromFullDetail.rmse, rows[5].fromFullDetail.rmse);
    EXPECT_EQ(rows[2].pyramidMilliseconds, 5);
    EXPECT_EQ(rows[5].pyramidMilliseconds, 7);
    EXPECT_EQ(rows[6].method.substr(0, 9), "circular:");
    EXPECT_EQ(rows[6].method.find(','), std::string::npos);
    // the mode is off, since a pinhole image has no blur that could hide coarse levels
    EXPECT_EQ(rows[6].mode, LodMode::off);
    EXPECT_GT(rows[6].fromFullDetail.rmse, 0);
    EXPECT_NE(speedupLine(rows[6]).find("circular"), std::string::npos);
    EXPECT_NE(speedupLine(rows[0]).find("published"), std::string::npos);
    const std::string csv = speedupCsv(rows);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 8 * commas);
}

}  // namespace
}  // namespace defocus::engine
