// End-to-end tests of `defocus bench convergence`: its files, resuming after a kill, and the report.

#include <nlohmann/json.hpp>

#include "cli/commands/bench_convergence.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(BenchConvergence, writesResultsJournalReferenceAndImages) {
    const Outcome outcome = bench({"-o", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("bias of accumulation"), std::string::npos) << outcome.out;
    // one row for each of three configurations and two sample counts
    EXPECT_EQ(rowsOf("out/results.csv", 0, 4).size(), 6u);
    EXPECT_EQ(rowsOf("out/runs.csv", 1, 5).size(), 12u);  // two runs of each configuration and sample count
    const json results = json::parse(textOf(folder() / "out/results.json"));
    EXPECT_TRUE(results.at("commands").at(0).get<std::string>().starts_with("defocus --quiet bench convergence"));
    EXPECT_FALSE(results.at("machine").at("system").get<std::string>().empty());
    EXPECT_GT(results.at("reference").at("remaining").at("mse").get<double>(), 0);
    EXPECT_EQ(results.at("crops").size(), 2u);
    EXPECT_TRUE(fs::exists(folder() / "out/reference.exr"));
    EXPECT_TRUE(fs::exists(folder() / "out" / results.at("reference").at("image").get<std::string>()));
    for (const json& row : results.at("rows")) {
        EXPECT_EQ(row.at("fault"), "");
        EXPECT_EQ(row.at("runs"), 2);
        for (const char* key : {"image", "errorMap"})
            EXPECT_TRUE(fs::exists(folder() / "out" / row.at(key).get<std::string>())) << row.at(key);
    }
}

TEST_F(BenchConvergence, aRunCutOffAnywhereIsTakenUp) {
    ASSERT_EQ(bench({"-o", "out"}).exitCode, 0);
    const auto full = rowsOf("out/runs.csv", 1, 5);
    const std::string journal = textOf(folder() / "out/runs.csv");
    for (const double share : {0.1, 0.43, 0.77, 0.999, 1.0}) {
        const auto length = static_cast<std::size_t>(share * static_cast<double>(journal.size()));
        std::ofstream(folder() / "out/runs.csv") << journal.substr(0, length);
        const Outcome outcome = bench({"-o", "out", "--resume"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        const auto rows = rowsOf("out/runs.csv", 1, 5);
        ASSERT_EQ(rows.size(), full.size()) << share;
        for (const auto& [key, cells] : full) {
            ASSERT_TRUE(rows.contains(key)) << key;
            EXPECT_EQ(rows.at(key).at(14), cells.at(14)) << key;  // column 14: mean squared error
        }
        EXPECT_EQ(rowsOf("out/results.csv", 0, 4).size(), 6u);
    }
    EXPECT_EQ(json::parse(textOf(folder() / "out/results.json")).at("commands").size(), 6u);
}

TEST_F(BenchConvergence, resumesNothingButTheSame) {
    // The helper bench() already passes --runs, which must not be given twice.
    ASSERT_EQ(bench({"-o", "out", "--runs", "1"}).exitCode, 2);
    ASSERT_EQ(bench({"-o", "out"}).exitCode, 0);
    const std::string journal = textOf(folder() / "out/runs.csv");
    const Outcome other = bench({"-o", "out", "--resume", "--focus-distance", "3"});
    expectOneLine(other, 1);
    EXPECT_NE(other.err.find("out/runs.csv"), std::string::npos) << other.err;
    EXPECT_EQ(textOf(folder() / "out/runs.csv"), journal);
}

// Existing results are overwritten only with --overwrite.
TEST_F(BenchConvergence, keepsWhatAFolderHoldsUnlessToldToOverwrite) {
    ASSERT_EQ(bench({"-o", "out"}).exitCode, 0);
    const auto contents = [&] {
        std::vector<std::string> texts;
        for (const char* file : {"reference.exr", "runs.csv", "results.csv", "results.json", "images/reference.png"})
            texts.push_back(textOf(folder() / "out" / file));
        return texts;
    };
    const std::vector<std::string> before = contents();
    const auto expectRefused = [&](const std::string& part, const std::vector<std::string>& arguments) {
        std::vector<std::string> words = {"-o", "out"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome outcome = bench(words);
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_TRUE(contents() == before) << outcome.err;
    };
    expectRefused("has 12 frames from an earlier run; continue with --resume, or start over with --overwrite", {});
    expectRefused("contains results for another scene", {"--focus-distance", "3"});
    expectRefused("contains results for another scene", {"--resume", "--focus-distance", "3"});
    // --resume also refuses another seed, although it gives the same reference image: the measured images differ
    expectRefused("contains results for another scene", {"--resume", "--seed", "7"});

    // The folder contains a reference image but no measured runs, as if the program had been killed before its first
    // run.
    fs::remove(folder() / "out/runs.csv");
    const std::string reference = textOf(folder() / "out/reference.exr");
    const Outcome other = bench({"-o", "out", "--focus-distance", "3"});
    expectOneLine(other, 1);
    EXPECT_NE(other.err.find("was rendered with a different scene"), std::string::npos) << other.err;
    EXPECT_TRUE(textOf(folder() / "out/reference.exr") == reference);

    ASSERT_EQ(bench({"-o", "out", "--focus-distance", "3", "--overwrite"}).exitCode, 0);
    EXPECT_FALSE(textOf(folder() / "out/reference.exr") == reference);
    EXPECT_EQ(rowsOf("out/runs.csv", 1, 5).size(), 12u);
    EXPECT_EQ(json::parse(textOf(folder() / "out/results.json")).at("commands").size(), 1u);
    expectOneLine(bench({"-o", "out", "--resume", "--overwrite"}), 2);
}

TEST_F(BenchConvergence, reportIsOneFileThatNeedsNothingElse) {
    const Outcome outcome = bench({"-o", "out", "--report", "page"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder() / "page/results.csv"));
    if (outcome.err.find("no report") != std::string::npos) GTEST_SKIP() << outcome.err;
    const std::string page = textOf(folder() / "page/index.html");
    expectSelfContained(page);
    EXPECT_NE(page.find("accumulation, full detail"), std::string::npos);
    EXPECT_NE(page.find("accumulation (published), jeong2011"), std::string::npos);
    for (const char* part : {"<nav ", "href=\"results.csv\"", "href=\"results.json\"", "@software{defocus", "aria-sort",
                             "data-value=\"accumulation, full detail, "})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_NE(page.find("defocus --quiet bench convergence quads.gltf"), std::string::npos);

    // strips.json adds images for side-by-side comparison to the report.
    std::ofstream(folder() / "page/strips.json")
        << R"([{"title": "A leak", "text": "of <colour>", "images": [{"label": "one", "file": "one.png"}]}])";
    fs::copy(folder() / "out/images/reference.png", folder() / "page/one.png");
    ASSERT_EQ(bench({"-o", "out", "--report", "page", "--resume"}).exitCode, 0);
    const std::string strips = textOf(folder() / "page/index.html");
    EXPECT_NE(strips.find("of &lt;colour&gt;"), std::string::npos);
    EXPECT_GT(strips.size(), page.size());
}

class BenchSpeedup : public GlProgramTest {
protected:
    nlohmann::json rows(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"--quiet", "bench",
                                              "speedup", "--fish",
                                              "1",       "--fish-triangles",
                                              "900",     "--size",
                                              "48x36",   "--counts",
                                              "4",       "--runs",
                                              "1",       "-o",
                                              "out",     "--reference-samples",
                                              "64",      "--allow-changed"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return nlohmann::json::parse(textOf(folder() / "out/speedup.json"))["rows"];
    }
};

// With --preset, `bench speedup` first measures with the preset, a published algorithm, and then without it.
// Further options override the preset; here they turn its levels of detail off.
TEST_F(BenchSpeedup, measuresAPresetBesideNone) {
    const nlohmann::json plain = rows({});
    ASSERT_EQ(plain.size(), 3u);
    for (const nlohmann::json& row : plain) EXPECT_EQ(row["preset"], "");
    const nlohmann::json both = rows({"--preset", "jeong2011", "--blur-threshold", "0", "--methods", "scheuermann"});
    ASSERT_EQ(both.size(), 7u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(both[i]["preset"], "jeong2011");
        EXPECT_EQ(both[i]["triangles"], both[0]["triangles"]);
        EXPECT_EQ(both[i]["fromFullDetail"]["rmse"], 0);
        for (const char* same : {"preset", "lod", "triangles", "fromFullDetail", "fromReference"})
            EXPECT_EQ(both[3 + i][same], plain[i][same]) << same;
    }
    EXPECT_LT(both[5]["triangles"], both[3]["triangles"]);
    // the preset uses Halton points, and the default is Sobol points
    EXPECT_NE(both[0]["fromReference"]["rmse"], both[3]["fromReference"]["rmse"]);
    EXPECT_EQ(both[6]["method"], "scheuermann");
}

}  // namespace
}  // namespace defocus::engine
