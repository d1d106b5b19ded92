#include "eval/bench_diff.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/convergence_text.h"
#include "eval/speedup_text.h"
#include "image/scratch_folder.h"

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
    ASSERT_EQ(difference.rows.size(), 4u);
    EXPECT_EQ(difference.rows[0].key, "accumulation lod=off 8");
    EXPECT_EQ(difference.rows[0].change, TimeChange::faster);
    EXPECT_DOUBLE_EQ(difference.rows[0].ratio, 0.5);
    EXPECT_DOUBLE_EQ(difference.rows[0].leastRatio, 40.0 / 110);
    EXPECT_DOUBLE_EQ(difference.rows[0].mostRatio, 80.0 / 90);
    EXPECT_EQ(difference.rows[1].change, TimeChange::none);
    EXPECT_NEAR(difference.rows[1].errors.at("flip"), 0.005, 1e-12);
    EXPECT_EQ(difference.rows[2].change, TimeChange::slower);
    EXPECT_EQ(difference.rows[3].change, TimeChange::none);
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
        EXPECT_EQ(row.change, TimeChange::none);
        EXPECT_EQ(row.ratio, 1);
        for (const auto& [column, error] : row.errors) EXPECT_EQ(error, 0) << column;
    }
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
    EXPECT_EQ(json.rows[0].milliseconds.high, 11);
    EXPECT_THROW(diffBenches(csv, parseBenchResults(convergenceCsv(before), "other")), Error);
}

TEST(BenchDiff, tableCountsTheChanges) {
    const std::string table = benchDifferenceTable(parseBenchResults(convergenceCsv(before), "old"),
                                                   parseBenchResults(convergenceCsv(after), "new"));
    EXPECT_NE(table.find("4 rows: 1 faster, 1 slower, 2 within noise"), std::string::npos) << table;
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
