// Tests those parts of `bench convergence` that need no GPU: rows, Pareto fronts, error floors, the journal of finished
// runs, measured cases and image crops.

#include "eval/convergence/convergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "eval/convergence/equal_error.h"
#include "eval/convergence/rows.h"
#include "eval/convergence/text.h"
#include "frame/setup/world_hash.h"
#include "scratch_folder.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

// ---- Pareto front ---------------------------------------------------------------------------------------------------

// The Pareto front of these trials is a, b, d and e.
//
// error
//  4 | a
//  3 |   b   c
//  2 |       d
//  1 |           e f
//    +------------- cost
TEST(ConvergenceFront, keepsWhatNoneBeats) {
    const std::vector<Trial> trials = {{1, 4}, {2, 3}, {4, 3}, {4, 2}, {6, 1}, {7, 1}};
    EXPECT_EQ(paretoFront(trials), (std::vector<bool>{true, true, false, true, true, false}));
}

TEST(ConvergenceFront, equalTrialsStandOrFallTogether) {
    EXPECT_EQ(paretoFront(std::vector<Trial>{{1, 1}, {1, 1}}), (std::vector<bool>{true, true}));
    EXPECT_EQ(paretoFront(std::vector<Trial>{{2, 1}, {2, 1}, {1, 1}}), (std::vector<bool>{false, false, true}));
    EXPECT_TRUE(paretoFront({}).empty());
}

// ---- time to an equal error -----------------------------------------------------------------------------------------

ConvergenceRow rowOf(const std::string& method, const std::string& setting, double milliseconds, double rmse) {
    ConvergenceRow row;
    row.method = method;
    row.setting = setting;
    row.milliseconds.median = milliseconds;
    row.error.mse = rmse * rmse;
    return row;
}

// The interpolated time to reach an error is exact if the error is a power function of the time.
TEST(EqualError, isExactForPowersOfTheTime) {
    std::vector<ConvergenceRow> rows;
    for (const double ms : {3.0, 48.0, 768.0}) {
        rows.push_back(rowOf("embree", "default", ms, 0.2 / std::sqrt(ms)));
        rows.push_back(rowOf("accumulation", "lod=off", ms, 0.3 / ms));
        rows.push_back(rowOf("accumulation", "lod=fractional", ms / 4, 0.3 / ms));
        rows.back().bias.emplace();
        // this row is dominated by another one, so it is ignored
        rows.push_back(rowOf("accumulation", "lod=fractional", ms, 0.4 / ms));
        rows.back().bias.emplace();
    }
    const std::vector<double> errors = {0.05, 0.01};
    const std::vector<Competitor> competitors = timesToErrors(rows, errors);
    ASSERT_EQ(competitors.size(), 3u);
    EXPECT_EQ(competitors[0].name, "accumulation with levels");
    EXPECT_EQ(competitors[1].name, "embree");
    EXPECT_EQ(competitors[2].name, "accumulation at full detail");
    for (std::size_t i = 0; i < errors.size(); ++i) {
        EXPECT_NEAR(*competitors[0].times[i].milliseconds, 0.3 / errors[i] / 4, 1e-9);
        EXPECT_NEAR(*competitors[1].times[i].milliseconds, std::pow(0.2 / errors[i], 2), 1e-9);
        EXPECT_NEAR(*competitors[2].times[i].milliseconds, 0.3 / errors[i], 1e-9);
    }
    EXPECT_NE(equalErrorTable(competitors).find("10.67x"), std::string::npos);  // the speed-up is 16 ms / 1.5 ms
}

TEST(EqualError, saysWhatLiesBeyondTheRows) {
    std::vector<ConvergenceRow> rows = {rowOf("a", "default", 10, 0.02), rowOf("a", "default", 20, 0.01),
                                        rowOf("b", "default", 1, 1e-9)};
    rows[2].fault = "NaN or infinite pixels";
    const std::vector<double> errors = {0.03, 0.01, 0.005};
    const std::vector<Competitor> competitors = timesToErrors(rows, errors);
    ASSERT_EQ(competitors.size(), 1u);
    const std::vector<Competitor::Time>& times = competitors[0].times;
    EXPECT_TRUE(times[0].atMost);
    EXPECT_DOUBLE_EQ(*times[0].milliseconds, 10);
    EXPECT_FALSE(times[1].atMost);
    EXPECT_DOUBLE_EQ(*times[1].milliseconds, 20);
    EXPECT_FALSE(times[2].milliseconds);
    EXPECT_TRUE(equalErrorTable(competitors).empty());
    EXPECT_TRUE(timesToErrors({}, errors).empty());
}

// ---- rows of results ------------------------------------------------------------------------------------------------

ConvergenceRun runOf(const std::string& method, const std::string& setting, std::uint32_t samples, int number,
                     double milliseconds, double mse) {
    ConvergenceRun run;
    run.method = method;
    run.setting = setting;
    run.asked = run.samples = samples;
    run.run = number;
    run.milliseconds = milliseconds;
    run.setupMilliseconds = 10 * milliseconds;
    run.error = {mse, 0.9, mse / 2};
    return run;
}

TEST(ConvergenceRows, areMediansOfTheirRunsInOrder) {
    const std::vector<ConvergenceRun> runs = {runOf("b", "x", 8, 0, 10, 0.25), runOf("a", "x", 8, 0, 3, 0.5),
                                              runOf("b", "x", 8, 1, 30, 0.25), runOf("b", "x", 16, 0, 50, 0.125),
                                              runOf("b", "x", 8, 2, 20, 0.25)};
    const std::vector<ConvergenceRow> rows = convergenceRows(runs);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].method, "b");
    EXPECT_EQ(rows[0].runs, 3);
    EXPECT_DOUBLE_EQ(rows[0].milliseconds.median, 20);
    EXPECT_DOUBLE_EQ(rows[0].milliseconds.low, 12);
    EXPECT_DOUBLE_EQ(rows[0].setupMilliseconds.high, 280);
    EXPECT_NEAR(rows[0].error.psnr(), 6.0206, 1e-4);
    EXPECT_EQ(rows[1].method, "a");
    EXPECT_EQ(rows[2].samples, 16u);
}

TEST(ConvergenceRows, markFrontsAndLeaveFaultsOff) {
    std::vector<ConvergenceRun> runs = {runOf("a", "x", 8, 0, 10, 0.5), runOf("a", "x", 16, 0, 20, 0.25),
                                        runOf("b", "x", 8, 0, 15, 0.2), runOf("b", "x", 16, 0, 1, 0.001)};
    runs[3].fault = "NaN or infinite pixels";
    runs[1].error.flip = 0.01;  // FLIP may rank images differently than the mean squared error
    const std::vector<ConvergenceRow> rows = convergenceRows(runs);
    EXPECT_TRUE(rows[0].front);
    // row 1 is not on the Pareto front, because method b with 8 samples is faster and more accurate
    EXPECT_FALSE(rows[1].front);
    EXPECT_TRUE(rows[1].frontOfMethod);
    EXPECT_TRUE(rows[1].frontByFlip);
    EXPECT_TRUE(rows[2].front);
    EXPECT_FALSE(rows[3].front || rows[3].frontOfMethod || rows[3].frontByFlip);
    EXPECT_NE(convergenceLine(rows[3]).find("NaN or infinite"), std::string::npos);
}

// Rows of the results mark errors below the reference image's own error, here an RMSE of 0.1 and a FLIP of 0.02.
TEST(ConvergenceRows, sayWhichErrorsAreBelowTheReferencesOwn) {
    std::vector<ConvergenceRun> runs;
    for (const auto& [mse, flip] : {std::pair{0.02, 0.03}, {0.009, 0.03}, {0.02, 0.01}, {0.009, 0.01}}) {
        runs.push_back(runOf("a", "x", static_cast<std::uint32_t>(runs.size() + 1), 0, 1, mse));
        runs.back().error.flip = flip;
    }
    Difference remaining;
    remaining.rmse = 0.1;
    remaining.flip = 0.02;
    const std::vector<ConvergenceRow> rows = convergenceRows(runs, remaining);
    const char* said[] = {"", "  PSNR below", "  FLIP below", "  PSNR and FLIP below"};
    const nlohmann::json json = nlohmann::json::parse(convergenceJson(rows, {}, {}));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].mseBelowReference, i % 2 == 1);
        EXPECT_EQ(rows[i].flipBelowReference, i >= 2);
        EXPECT_NE(convergenceLine(rows[i]).find(said[i]), std::string::npos);
        EXPECT_EQ(convergenceLine(rows[i]).find("below") == std::string::npos, i == 0);
        EXPECT_EQ(json["rows"][i]["mseBelowReference"], i % 2 == 1);
        EXPECT_EQ(json["rows"][i]["flipBelowReference"], i >= 2);
    }
}

// With two alternating seeds, a row's error is the mean over the seeds, and each seed counts once. Images of runs with
// the same seed must be equal; images of different seeds may differ.
TEST(ConvergenceRows, errorsAreMeansOverSeeds) {
    const std::vector<ConvergenceRun> runs = {runOf("a", "x", 8, 0, 1, 0.25), runOf("a", "x", 8, 1, 1, 0.75),
                                              runOf("a", "x", 8, 2, 1, 0.25)};
    const ConvergenceRow row = convergenceRows(runs, {}, 2)[0];
    EXPECT_EQ(row.fault, "");
    EXPECT_EQ(row.ofSeeds.size(), 2u);
    EXPECT_DOUBLE_EQ(row.error.mse, 0.5);
    EXPECT_DOUBLE_EQ(row.error.flip, 0.25);
    EXPECT_NE(convergenceRows(runs)[0].fault, "") << "runs with the same seed must give the same image";
    EXPECT_NE(convergenceRows(std::vector{runs[0], runs[1], runOf("a", "x", 8, 2, 1, 0.3)}, {}, 2)[0].fault, "");
}

TEST(ConvergenceRows, runsThatDifferAreAFault) {
    EXPECT_NE(convergenceRows(std::vector{runOf("a", "x", 8, 0, 1, 0.5), runOf("a", "x", 8, 1, 1, 0.51)})[0].fault, "");
    EXPECT_EQ(convergenceRows(std::vector{runOf("a", "x", 8, 0, 1, 0.5), runOf("a", "x", 8, 1, 1, 0.504)})[0].fault,
              "");
}

TEST(ConvergenceRows, biasFloorsAreThoseOfTheMostSamples) {
    std::vector<ConvergenceRun> runs = {runOf("a", "off", 16, 0, 1, 0.5), runOf("a", "coarse", 16, 0, 1, 0.5),
                                        runOf("a", "coarse", 64, 0, 1, 0.5), runOf("a", "coarse", 4, 0, 1, 0.5)};
    runs[1].bias = ImageError{0.3, 1, 0};
    runs[2].bias = ImageError{0.2, 1, 0};
    runs[3].bias = ImageError{0.1, 1, 0};
    const std::vector<BiasFloor> floors = biasFloors(convergenceRows(runs));
    ASSERT_EQ(floors.size(), 1u);
    EXPECT_EQ(floors[0].samples, 64u);
    EXPECT_EQ(floors[0].error.mse, 0.2);
}

// ---- journal of finished runs ---------------------------------------------------------------------------------------

std::vector<ConvergenceRun> threeRuns() {
    std::vector<ConvergenceRun> runs = {runOf("accumulation", "lod=off", 8, 0, 1.0 / 3, 0.1),
                                        runOf("accumulation", "lod=fractional metric=size thresholds=2", 8, 0, 2e-5, 0),
                                        runOf("circular", "default", 0, 1, 12345.678, 1e-9)};
    runs[0].imageHash = ~0ull;
    runs[0].triangles = 1ull << 40;
    runs[0].form = "best";
    runs[1].bias = ImageError{1.0 / 7, 0.5, 1e-17};
    runs[2].samples = 4;
    runs[2].fault = "3 lens samples instead of 4";
    return runs;
}

bool same(const ConvergenceRun& a, const ConvergenceRun& b) {
    const auto equal = [](const ImageError& x, const ImageError& y) {
        return x.mse == y.mse && x.ssim == y.ssim && x.flip == y.flip;
    };
    return a.method == b.method && a.form == b.form && a.setting == b.setting && a.asked == b.asked && a.run == b.run &&
           a.samples == b.samples && a.milliseconds == b.milliseconds && a.setupMilliseconds == b.setupMilliseconds &&
           a.triangles == b.triangles && a.imageHash == b.imageHash && equal(a.error, b.error) &&
           a.bias.has_value() == b.bias.has_value() && (!a.bias || equal(*a.bias, *b.bias)) && a.fault == b.fault;
}

TEST(ConvergenceJournal, cutAnywhereItHoldsTheWholeLinesBeforeTheCut) {
    const std::vector<ConvergenceRun> runs = threeRuns();
    const std::string text = runsCsv(runs, 7);
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        const std::string left = text.substr(0, cut);
        const std::vector<ConvergenceRun> read = readRunsCsv(left, 7, "runs.csv");
        const auto lines = std::count(left.begin(), left.end(), '\n');
        ASSERT_EQ(read.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, lines - 1))) << cut;
        for (std::size_t i = 0; i < read.size(); ++i) ASSERT_TRUE(same(read[i], runs[i])) << cut;
    }
}

TEST(ConvergenceJournal, ofAnotherSubjectOrNoneIsAnError) {
    const std::string text = runsCsv(threeRuns(), 7);
    EXPECT_NE(messageOf<Error>([&] { readRunsCsv(text, 8, "runs.csv"); }).find("another scene"), std::string::npos);
    EXPECT_NE(messageOf<Error>([&] { readRunsCsv("a,b\n1,2\n", 7, "runs.csv"); }).find("runs.csv"), std::string::npos);
    const std::string header = runsCsv({}, 7);
    for (const char* line : {"\n", "7,a\n", "7,a,c,b,1,0,1,0,0,x,0,0,0,0,0,0,0,,,,\n", ",,,,,,,,,,,,,,,,,,,,\n"})
        EXPECT_NE(messageOf<Error>([&] { readRunsCsv(header + line, 7, "runs.csv"); }).find("line 2"),
                  std::string::npos)
            << line;
}

TEST(ConvergenceFiles, csvAndJsonHoldEveryRow) {
    const std::vector<ConvergenceRow> rows = convergenceRows(threeRuns());
    const std::string csv = convergenceCsv(rows);
    EXPECT_TRUE(csv.starts_with("method,form,setting,samples,takesLensSamples,runs,milliseconds.median,"));
    ASSERT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 4 * commas);

    const nlohmann::json json = nlohmann::json::parse(convergenceJson(rows, {}, {}));
    ASSERT_EQ(json["rows"].size(), 3u);
    EXPECT_TRUE(json["rows"][1]["psnr"].is_null());  // the PSNR is null, since the images are equal
    EXPECT_DOUBLE_EQ(json["rows"][1]["bias"]["mse"].get<double>(), 1.0 / 7);
    EXPECT_EQ(json["rows"][2]["samples"], 4);
    EXPECT_EQ(json["biasFloors"].size(), 1u);
    std::set<std::string> images;
    for (const nlohmann::json& row : json["rows"]) images.insert(row["image"].get<std::string>());
    EXPECT_EQ(images.size(), 3u);
}

// ---- list of measured cases -----------------------------------------------------------------------------------------

TEST(ConvergenceCases, followTheTableAndTheLists) {
    registerMethod({.name = "rays", .description = "", .needsGl = false, .settings = {}, .make = {}});
    registerMethod({.name = "blur",
                    .description = "",
                    .usesLensSamples = false,
                    .settings = {{.name = "taps", .defaultValue = "8", .description = "", .choices = {}, .max = 64}},
                    .make = {}});
    registerMethod({.name = "embree", .description = "", .needsGl = false, .settings = {}, .make = {}});
    const auto texts = [](const ConvergenceOptions& options) {
        std::vector<std::string> found;
        for (const ConvergenceCase& one : convergenceCases(options))
            found.push_back(fmt::format("{} {} {}", one.use.method->name, one.setting, one.samples));
        return found;
    };
    ConvergenceOptions options;
    options.sampleCounts = {16, 4, 16};
    options.lods = {LodMode::off, LodMode::nearest};
    options.metrics = {LodMetric::error};
    options.thresholdFactors = {0.5};
    options.methods = {parseMethodUse("accumulation"), parseMethodUse("blur:taps=3"), parseMethodUse("blur"),
                       parseMethodUse("rays")};
    EXPECT_EQ(texts(options),
              (std::vector<std::string>{
                  "accumulation lod=off 4", "accumulation lod=nearest metric=error thresholds=0.5 4", "blur taps=3 0",
                  "blur default 0", "rays default 4", "embree default 4", "accumulation lod=off 16",
                  "accumulation lod=nearest metric=error thresholds=0.5 16", "rays default 16", "embree default 16"}));

    // The cases always include full detail and the ray tracer `embree`. Without a list of methods, they include every
    // method except `auto`, which only chooses between two other methods.
    options.lods = {LodMode::nearest};
    options.sampleCounts = {4};
    options.methods = {parseMethodUse("blur")};
    EXPECT_EQ(texts(options),
              (std::vector<std::string>{"accumulation lod=off 4", "blur default 0", "embree default 4"}));
    options.methods.clear();
    std::set<std::string> names;
    for (const ConvergenceCase& one : convergenceCases(options)) names.insert(one.use.method->name);
    EXPECT_EQ(names.size(), methods().size() - 1);
    EXPECT_FALSE(names.contains(automaticMethod));
}

// A method without custom settings has three rows: for its published, best and default settings. A method with custom
// settings has only one row.
TEST(ConvergenceCases, formsArePublishedBestAndDefault) {
    registerMethod({.name = "formed",
                    .description = "",
                    .usesLensSamples = false,
                    .settings = {{.name = "taps", .defaultValue = "8", .description = "", .choices = {}, .max = 64}},
                    .best = {{"taps", "64"}},
                    .make = {}});
    const World world;
    ConvergenceOptions options;
    options.sampleCounts = {16};
    options.lods = {LodMode::off};
    options.methods = {parseMethodUse("formed"), parseMethodUse("formed:taps=9"), parseMethodUse("accumulation")};
    options.published = {{.preset = "old2004", .use = parseMethodUse("formed:taps=2")},
                         {.preset = "jeong2011",
                          .use = parseMethodUse("accumulation"),
                          .plan = {.lod = LodMode::nearest},
                          .world = &world},
                         {.preset = "other1999", .use = parseMethodUse("multirate")}};
    const auto texts = [&] {
        std::set<std::string> found;
        for (const ConvergenceCase& one : convergenceCases(options))
            found.insert(fmt::format("{}|{}|{}", one.use.text(), one.form, one.setting));
        return found;
    };
    using Texts = std::set<std::string>;
    Texts expected = {"accumulation|default|lod=off",    "accumulation|published|jeong2011",
                      "formed:taps=2|published|old2004", "formed:taps=64|best|taps=64",
                      "formed|default|default",          "formed:taps=9||taps=9"};
    for (const ConvergenceCase& one : convergenceCases(options))
        if (one.use.method->name == "embree") expected.insert("embree|default|default");
    EXPECT_EQ(texts(), expected);
    for (const ConvergenceCase& one : convergenceCases(options)) {
        const bool levels = one.setting == "jeong2011";
        EXPECT_EQ(one.world, levels ? &world : nullptr) << one.setting;
        EXPECT_EQ(one.usesLevels(), levels) << one.setting;
    }

    options.forms = {MethodForm::published};
    std::erase_if(expected, [](const std::string& text) {
        const bool given = text.find("=9") != text.npos;
        const bool published = text.find("published") != text.npos;
        return text.starts_with("embree") || (text.starts_with("formed") && !published && !given);
    });
    EXPECT_EQ(texts(), expected);
}

TEST(ConvergenceCases, thresholdsAreTimesTheDefaults) {
    ConvergenceOptions options;
    options.sampleCounts = {64};
    options.lods = {LodMode::fractional};
    options.thresholdFactors = {3};
    options.methods = {parseMethodUse("accumulation")};
    const ConvergenceCase levels = convergenceCases(options).at(1);
    const LodThresholds defaults = defaultThresholds(LodMetric::measured, 64);
    EXPECT_DOUBLE_EQ(levels.plan.thresholds.light.value(), 3 * defaults.light);
    EXPECT_TRUE(levels.usesLevels());
}

// ---- image crops in the report --------------------------------------------------------------------------------------

// 0 0 0 0 0      the 2 × 2 square with the largest sum begins at (3, 1): 1 + 4;
// 0 0 0 1 0      outside that square, the first square with the sum 3 begins at (0, 1).
// 3 0 0 0 4
TEST(ConvergenceCrops, areWhereTheSumIsLargest) {
    Image values(5, 3, 1);
    *values.at(3, 1) = 1;
    *values.at(4, 2) = 4;
    *values.at(0, 2) = 3;
    const std::optional<Crop> best = largestSquare(values, 2);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->x, 3);
    EXPECT_EQ(best->y, 1);
    const std::optional<Crop> second = largestSquare(values, 2, best);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->x, 0);
    EXPECT_EQ(second->y, 1);
    EXPECT_FALSE(largestSquare(values, 4));
    // no second square exists, since every 3 × 3 square overlaps the given crop in the middle column
    EXPECT_FALSE(largestSquare(values, 3, Crop{"", 2, 1, 1, 1}));
}

TEST(ConvergenceCrops, mayTouch) {
    Image values(4, 2, 1);
    *values.at(0, 0) = 5;
    *values.at(3, 0) = 3;
    const std::optional<Crop> best = largestSquare(values, 2);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->x, 0);
    const std::optional<Crop> second = largestSquare(values, 2, best);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->x, 2);
}

// ---- hash of the world ----------------------------------------------------------------------------------------------

TEST(ConvergenceHash, changesWithWhateverTheImageShows) {
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    const std::uint64_t hash = worldHash(small->world, small->view);
    EXPECT_EQ(hash, worldHash(small->world, small->view));
    std::set<std::uint64_t> hashes = {hash};
    const auto changed = [&](auto&& value, auto other) {
        const auto kept = value;
        value = other;
        EXPECT_TRUE(hashes.insert(worldHash(small->world, small->view)).second) << hashes.size();
        value = kept;
    };
    changed(small->scene.meshes[0].vertices.positions[7].x, 0.125f);
    changed(small->scene.meshes[0].vertices.colors[7].g, 0.3f);
    changed(small->scene.meshes[0].primitives[0].material, -1);
    changed(small->scene.materials[0].roughnessFactor, 0.41f);
    changed(small->scene.materials[0].unlit, true);
    changed(small->world.pose.objects[1].worldFromObject[3].x, 0.30001);
    changed(small->world.pose.objects[1].cocScale, 0.5);
    changed(small->world.lights[0].light.intensity, 3.0f);
    changed(small->world.environment.nadir.z, 0.25f);
    changed(small->view.width, 161);
    changed(small->view.nearPlane, 0.02);
    changed(small->view.lens.fStop, 1.1);
    changed(small->view.lens.bladeCount, 6);
    changed(small->view.lens.bladeCurvature, 0.5);
    changed(small->view.lens.apertureImage, std::make_shared<const Image>(Image(1, 1, 1)));
    changed(small->view.worldFromCamera[3].z, 0.001);
    EXPECT_EQ(hash, worldHash(small->world, small->view));
}

TEST(ConvergenceHash, changesWithTheShaders) {
    const std::unique_ptr<SmallWorld> small = fiveSpheres();
    const ScratchFolder folder;
    const std::uint64_t empty = worldHash(small->world, small->view, folder.path());
    std::ofstream(folder / "object.frag") << "one";
    const std::uint64_t one = worldHash(small->world, small->view, folder.path());
    std::ofstream(folder / "object.frag") << "two";
    EXPECT_NE(one, empty);
    EXPECT_NE(worldHash(small->world, small->view, folder.path()), one);
    EXPECT_THROW(worldHash(small->world, small->view, folder / "missing"), Error);
}

}  // namespace
}  // namespace defocus::engine
