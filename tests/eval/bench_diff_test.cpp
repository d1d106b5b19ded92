#include "eval/bench_diff.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/convergence/text.h"
#include "eval/popping/text.h"
#include "eval/scaling/text.h"
#include "eval/speedup/text.h"
#include "eval/stability/text.h"
#include "scratch_folder.h"

namespace defocus {
namespace {

ConvergenceRow rowOf(const std::string& setting, std::uint32_t samples, Spread milliseconds, double flip) {
    ConvergenceRow row;
    row.method = "accumulation";
    row.setting = setting;
    row.asked = row.samples = samples;
    row.runs = 3;
    row.milliseconds = milliseconds;
    row.error = {1e-4, 0.99, flip};
    return row;
}

const std::vector<ConvergenceRow> before = {
    rowOf("lod=off", 8, {100, 90, 110}, 0.02),   rowOf("lod=off", 16, {200, 190, 210}, 0.01),
    rowOf("lod=off", 32, {400, 390, 410}, 0.01), rowOf("lod=off", 64, {800, 800, 800}, 0.01),
    rowOf("lod=off", 256, {10, 9, 11}, 0.01),
};
const std::vector<ConvergenceRow> after = {
    rowOf("lod=off", 32, {500, 411, 510}, 0.01),   // slower: the spreads share nothing
    rowOf("lod=off", 16, {150, 130, 190}, 0.015),  // they touch at 190
    rowOf("lod=off", 8, {50, 40, 80}, 0.02),       // faster
    rowOf("lod=off", 128, {1, 1, 1}, 0.01),
    rowOf("lod=off", 256, {20, 10, 30}, 0.01),  // twice the median, but too noisy to tell
};

BenchDifference differenceOf(const std::string& old, const std::string& now) {
    return diffBenches(parseBenchResults(old, "old"), parseBenchResults(now, "new"));
}

void expectTheDifference(const BenchDifference& difference) {
    EXPECT_TRUE(difference.unlike.empty());
    ASSERT_EQ(difference.rows.size(), 4u);
    for (const RowDifference& row : difference.rows) ASSERT_TRUE(row.time);
    EXPECT_EQ(difference.rows[0].key, "accumulation lod=off 8");
    const TimeDifference& first = *difference.rows[0].time;
    EXPECT_EQ(first.change, TimeChange::faster);
    EXPECT_DOUBLE_EQ(first.ratio, 0.5);
    EXPECT_DOUBLE_EQ(first.leastRatio, 40.0 / 110);
    EXPECT_DOUBLE_EQ(first.mostRatio, 80.0 / 90);
    EXPECT_EQ(difference.rows[0].errors.at("flip").change, ErrorChange::none);
    EXPECT_EQ(difference.rows[1].time->change, TimeChange::none);
    EXPECT_NEAR(difference.rows[1].errors.at("flip").before, 0.01, 1e-12);
    EXPECT_NEAR(difference.rows[1].errors.at("flip").after, 0.015, 1e-12);
    EXPECT_EQ(difference.rows[1].errors.at("flip").change, ErrorChange::farther);
    EXPECT_EQ(difference.rows[2].time->change, TimeChange::slower);
    EXPECT_EQ(difference.rows[3].time->change, TimeChange::none);
    EXPECT_EQ(difference.onlyBefore, std::vector<std::string>{"accumulation lod=off 64"});
    EXPECT_EQ(difference.onlyAfter, std::vector<std::string>{"accumulation lod=off 128"});
}

TEST(BenchDiff, saysWhatChangedBeyondTheNoise) {
    const std::string oldJson = convergenceJson(before, {}, {});
    const std::string newJson = convergenceJson(after, {}, {});
    expectTheDifference(differenceOf(oldJson, newJson));
    expectTheDifference(differenceOf(convergenceCsv(before), convergenceCsv(after)));
    expectTheDifference(differenceOf(convergenceCsv(before), newJson));  // both say the same
}

TEST(BenchDiff, ofAFileWithItselfIsNothing) {
    const std::string csv = convergenceCsv(before);
    for (const RowDifference& row : differenceOf(csv, csv).rows) {
        EXPECT_EQ(row.time->change, TimeChange::none);
        EXPECT_EQ(row.time->ratio, 1);
        EXPECT_GE(row.errors.size(), 4u);
        for (const auto& [column, error] : row.errors) EXPECT_EQ(error.change, ErrorChange::none) << column;
    }
}

// Their spreads have no width, or as good as none.
TEST(BenchDiff, ofFewerThanThreeRunsHasNoVerdict) {
    for (const int runs : {1, 2, 3}) {
        ConvergenceRow old = rowOf("lod=off", 8, {100, 100, 100}, 0.02);
        ConvergenceRow now = rowOf("lod=off", 8, {101, 101, 101}, 0.02);
        old.runs = runs;
        const BenchDifference difference =
            differenceOf(convergenceCsv(std::vector{old}), convergenceCsv(std::vector{now}));
        const TimeDifference& time = *difference.rows.at(0).time;
        EXPECT_EQ(time.change, runs < 3 ? TimeChange::unknown : TimeChange::slower) << runs;
        EXPECT_EQ(time.unknownBecause, runs == 1 ? "one run" : runs == 2 ? "2 runs" : "");
    }
    std::string csv = convergenceCsv(before);
    csv.replace(csv.find(",runs,"), 6, ",once,");
    const BenchDifference difference = differenceOf(csv, csv);
    EXPECT_EQ(difference.rows[0].time->unknownBecause, "runs not said");
}

// 1 % of an RMSE are 0.0864 dB of PSNR; of SSIM 0.99 it is 0.0001.
TEST(BenchDiff, errorsChangeByMoreThanAHundredth) {
    const auto changeOf = [](const std::string& column, double mse, double ssim, double flip) {
        ConvergenceRow old = rowOf("lod=off", 8, {1, 1, 1}, 0.02);
        ConvergenceRow now = old;
        now.error = {mse, ssim, flip};
        const BenchDifference difference =
            differenceOf(convergenceJson(std::vector{old}, {}, {}), convergenceJson(std::vector{now}, {}, {}));
        return difference.rows.at(0).errors.at(column).change;
    };
    const double within = 1e-4 * 1.009 * 1.009;
    const double beyond = 1e-4 * 1.011 * 1.011;
    for (const char* column : {"rmse", "psnr"}) {
        EXPECT_EQ(changeOf(column, within, 0.99, 0.02), ErrorChange::none) << column;
        EXPECT_EQ(changeOf(column, beyond, 0.99, 0.02), ErrorChange::farther) << column;
        EXPECT_EQ(changeOf(column, 1e-4 / 1.011 / 1.011, 0.99, 0.02), ErrorChange::closer) << column;
    }
    EXPECT_EQ(changeOf("ssim", 1e-4, 0.99009, 0.02), ErrorChange::none);
    EXPECT_EQ(changeOf("ssim", 1e-4, 0.99012, 0.02), ErrorChange::closer);
    EXPECT_EQ(changeOf("ssim", 1e-4, 0.98988, 0.02), ErrorChange::farther);
    EXPECT_EQ(changeOf("flip", 1e-4, 0.99, 0.0201), ErrorChange::none);
    EXPECT_EQ(changeOf("flip", 1e-4, 0.99, 0.0203), ErrorChange::farther);
    EXPECT_EQ(changeOf("flip", 1e-4, 0.99, 0), ErrorChange::closer);
}

// ---- what can't be compared -----------------------------------------------------------------------------------------

ConvergenceSubject subjectOf() {
    ConvergenceSubject subject;
    subject.bench.scene = "fish.glb";
    subject.bench.camera = "main";
    subject.bench.lens = Lens{};
    subject.bench.width = 64;
    subject.bench.height = 48;
    subject.bench.machine = {"a processor", 2, 1, "a system"};
    subject.bench.device = "a device";
    subject.bench.driver = "a driver";
    return subject;
}

TEST(BenchDiff, ofUnlikeSubjectsSaysSoAndGivesNoVerdict) {
    ReferenceImage reference;
    reference.samples = 64;
    std::vector<ConvergenceRow> rows = {rowOf("lod=fractional", 8, {100, 90, 110}, 0.02)};
    rows[0].bias = ImageError{1e-5, 0.999, 0.01};
    std::vector<ConvergenceRow> other = {rowOf("lod=fractional", 8, {50, 40, 60}, 0.01)};
    other[0].bias = ImageError{1e-6, 0.9999, 0.005};
    const ConvergenceSubject subject = subjectOf();
    const std::string old = convergenceJson(rows, reference, subject);
    const auto expect = [&](const char* what, bool times, bool errors, bool bias, const ConvergenceSubject& changed,
                            const ReferenceImage& changedReference) {
        const BenchDifference difference = differenceOf(old, convergenceJson(other, changedReference, changed));
        ASSERT_EQ(difference.unlike.size(), *what == '\0' ? 0u : 1u) << what;
        if (*what != '\0') {
            EXPECT_TRUE(difference.unlike[0].starts_with("another " + std::string(what) + ":")) << difference.unlike[0];
        }
        const RowDifference& row = difference.rows.at(0);
        EXPECT_EQ(row.time->change, times ? TimeChange::faster : TimeChange::unknown) << what;
        EXPECT_EQ(row.errors.at("flip").change, errors ? ErrorChange::closer : ErrorChange::unknown) << what;
        EXPECT_EQ(row.errors.at("biasFlip").change, bias ? ErrorChange::closer : ErrorChange::unknown) << what;
    };
    const auto expectOf = [&](const char* what, bool times, bool errors, const auto& change) {
        ConvergenceSubject changed = subject;
        change(changed.bench);
        expect(what, times, errors, errors, changed, reference);
    };
    expectOf("", true, true, [](BenchSubject& bench) { bench.commit = "another"; });
    expectOf("scene", false, false, [](BenchSubject& bench) { bench.scene = "bird.glb"; });
    expectOf("camera", false, false, [](BenchSubject& bench) { bench.camera = "other"; });
    expectOf("size", false, false, [](BenchSubject& bench) { bench.width = 160; });
    expectOf("lens fStop", false, false, [](BenchSubject& bench) { bench.lens->fStop *= 2; });
    expectOf("device", false, false, [](BenchSubject& bench) { bench.device = "another"; });
    expectOf("driver", false, false, [](BenchSubject& bench) { bench.driver = "another"; });
    expectOf("machine", false, true, [](BenchSubject& bench) { bench.machine.processor = "another"; });
    ReferenceImage more = reference;
    more.samples = 128;
    expect("reference", true, false, true, subject, more);
}

TEST(BenchDiff, ofRowsWithOtherReferencesComparesTheRest) {
    SpeedupRow old;
    old.runs = 3;
    old.fromFullDetail.flip = 0.02;
    old.fromReference = old.fromFullDetail;
    old.referenceSamples = 512;
    SpeedupRow now = old;
    now.fromFullDetail.flip = now.fromReference->flip = 0.01;
    const auto changes = [&] {
        const BenchDifference difference =
            differenceOf(speedupCsv(std::vector{old}), speedupJson(std::vector{now}, {}));
        return std::pair{difference.rows.at(0).errors.at("flipFull").change,
                         difference.rows[0].errors.at("flipReference").change};
    };
    EXPECT_EQ(changes(), (std::pair{ErrorChange::closer, ErrorChange::closer}));
    now.referenceSamples = 1024;
    EXPECT_EQ(changes(), (std::pair{ErrorChange::closer, ErrorChange::unknown}));
}

// ---- the other benches ----------------------------------------------------------------------------------------------

TEST(BenchDiff, readsScaling) {
    ScalingRow row;
    row.axis = ScalingAxis::blur;
    row.value = 1.0 / 3;
    setTimes(row, {{10, 11, 12}, {1, 1, 1}, {2, 2, 2}});
    ScalingRow slower = row;
    setTimes(slower, {{20, 21, 22}, {1, 1, 1}, {2, 2, 2}});
    BenchSubject subject;
    subject.runs = 3;
    const BenchDifference difference =
        differenceOf(scalingCsv(std::vector{row}), scalingJson(std::vector{slower}, {}, {}, subject));
    ASSERT_EQ(difference.rows.size(), 1u);
    EXPECT_EQ(difference.rows[0].time->change, TimeChange::slower);
    EXPECT_TRUE(difference.rows[0].errors.empty());
}

TEST(BenchDiff, readsPopping) {
    PoppingFrame frame;
    frame.samples = 8;
    frame.mode = PoppingMode::fractional;
    frame.frame = 3;
    frame.step.objects.rmse = 0.02;
    PoppingFrame less = frame;
    less.step.objects.rmse = 0.01;
    const auto jsonOf = [](const PoppingFrame& one, int frames) {
        PoppingOptions options;
        options.frames = frames;
        return poppingJson(std::vector{one}, {}, {}, options);
    };
    for (const BenchDifference& difference :
         {differenceOf(jsonOf(frame, 48), jsonOf(less, 48)),
          differenceOf(poppingCsv(std::vector{frame}), poppingCsv(std::vector{less}))}) {
        ASSERT_EQ(difference.rows.size(), 1u);
        EXPECT_FALSE(difference.rows[0].time);
        EXPECT_EQ(difference.rows[0].errors.at("stepRmse").change, ErrorChange::closer);
        EXPECT_EQ(difference.rows[0].errors.at("changeRmse").change, ErrorChange::none);
    }
    EXPECT_EQ(differenceOf(jsonOf(frame, 48), jsonOf(less, 24)).unlike.size(), 1u);
    EXPECT_THROW(differenceOf(jsonOf(frame, 48), poppingCsv(std::vector{less})),
                 Error);  // of whole movements, of frames
}

TEST(BenchDiff, readsStabilityAndItsLimits) {
    StabilityRow kept;
    kept.subject = {"sums", "one", "", "", 1e-6, {}};
    kept.error = 2e-7;
    StabilityRow broken = kept;
    broken.error = 2e-6;
    HonestyRow disk{"accumulation", "f/2", 10, 10.1, 1};
    HonestyRow wide = disk;
    wide.measured = 9.8;
    const BenchDifference difference = differenceOf(stabilityJson(std::vector{kept}, std::vector{disk}, {}),
                                                    stabilityJson(std::vector{broken}, std::vector{wide}, {}));
    ASSERT_EQ(difference.rows.size(), 2u);
    EXPECT_EQ(difference.rows[0].key, "sums one");
    EXPECT_TRUE(difference.rows[0].errors.at("error").beyondLimit);
    EXPECT_EQ(difference.rows[1].key, "accumulation f/2");
    EXPECT_EQ(difference.rows[1].errors.at("diameterError").change, ErrorChange::farther);
    EXPECT_NEAR(difference.rows[1].errors.at("diameterError").after, 0.2, 1e-12);
    EXPECT_EQ(difference.rows[1].errors.at("energyError").change, ErrorChange::none);
}

TEST(BenchDiff, readsSpeedupFromCsvAndJsonAlike) {
    SpeedupRow row;
    row.sweep = "aperture";
    row.samples = 64;
    row.fStop = 2.8;
    row.focusDistance = 1.0 / 3;
    row.mode = LodMode::fractional;
    row.milliseconds = {10, 9, 11};
    row.fromFullDetail.psnr = 40;
    row.fromReference = Difference{};
    row.fromReference->flip = 0.125;
    row.fromReference->psnr = 30;
    const std::vector<SpeedupRow> rows = {row};
    const BenchResults csv = parseBenchResults(speedupCsv(rows), "csv");
    const BenchResults json = parseBenchResults(speedupJson(rows, {}), "json");
    ASSERT_EQ(csv.rows.size(), 1u);
    EXPECT_EQ(csv.bench, "speedup");
    EXPECT_EQ(csv.rows[0].key, json.rows.at(0).key);
    EXPECT_EQ(csv.rows[0].errors.at("flipReference"), 0.125);
    EXPECT_EQ(csv.rows[0].errors, json.rows[0].errors);
    EXPECT_EQ(json.rows[0].milliseconds->high, 11);
    EXPECT_THROW(diffBenches(csv, parseBenchResults(convergenceCsv(before), "other")), Error);
}

// Rows of a preset and of another method are their own; the rest has the key that it had before there were any.
TEST(BenchDiff, tellsPresetsAndMethodsOfSpeedupApart) {
    SpeedupRow row;
    row.sweep = "samples";
    row.samples = 64;
    row.milliseconds = {10, 9, 11};
    row.method = "accumulation";
    std::vector<SpeedupRow> rows(3, row);
    rows[1].preset = "jeong2011";
    rows[2].method = "circular:far-components=2 resolution=half";
    const BenchResults csv = parseBenchResults(speedupCsv(rows), "csv");
    const BenchResults json = parseBenchResults(speedupJson(rows, {}), "json");
    for (const BenchResults& results : {csv, json}) {
        ASSERT_EQ(results.rows.size(), 3u);
        EXPECT_EQ(results.rows[0].key, "samples 64 0 0 off");
        EXPECT_EQ(results.rows[1].key, "samples 64 0 0 off jeong2011");
        EXPECT_EQ(results.rows[2].key, "samples 64 0 0 off circular:far-components=2 resolution=half");
    }
}

TEST(BenchDiff, tableCountsTheChanges) {
    const std::string table = benchDifferenceTable(parseBenchResults(convergenceCsv(before), "old"),
                                                   parseBenchResults(convergenceCsv(after), "new"));
    EXPECT_NE(table.find("4 rows: 1 faster, 1 slower, 2 within noise, 0 unknown"), std::string::npos) << table;
    EXPECT_NE(table.find("errors: 0 closer, 1 farther, 15 alike, 0 not comparable"), std::string::npos) << table;
    EXPECT_NE(table.find("flip 0.01 to 0.015 farther"), std::string::npos) << table;
    EXPECT_NE(table.find("only in old: accumulation lod=off 64"), std::string::npos) << table;
}

TEST(BenchDiff, otherTextsAreAnErrorThatNamesThem) {
    const std::string csv = convergenceCsv(before);
    const std::string cut = csv.substr(0, csv.size() - 30);
    const std::vector<std::string> texts = {"",
                                            "a,b\n1,2\n",
                                            "{",
                                            "{}",
                                            R"({"rows": [1]})",
                                            R"({"rows": [{"samples": 1}]})",
                                            "method,setting,samples\na,b,1\n",
                                            cut};
    for (const std::string& text : texts)
        EXPECT_NE(messageOf<Error>([&] { parseBenchResults(text, "file"); }).find("file"), std::string::npos) << text;
}

}  // namespace
}  // namespace defocus
