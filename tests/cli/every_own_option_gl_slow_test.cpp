// Tests that every option that belongs to a single command has an effect; every_option_gl_slow_test.cpp checks the
// settings. option_cases_test.cpp checks that each option of each command has a test case or a test of its own.

#include <set>

#include "cli/commands/bench_commands.h"
#include "cli/option_test.h"
#include "cli/own_option_cases.h"
#include "core/error.h"
#include "eval/scaling/scaling.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// ---- options that are tested by two command lines: one with the option, one without it -----------------------------

class OwnOption : public OptionTest {
protected:
    void SetUp() override {
        OptionTest::SetUp();
        fs::copy(folder() / "sky.hdr", folder() / "one.exr");
        Image image = readImage(folder() / "one.exr");
        for (float& value : image.pixels) value *= 1.1f;
        writeImage(folder() / "two.exr", image);
        for (float& value : image.pixels) value = 1 - value;
        writeImage(folder() / "three.exr", image);
        const fs::path source = DEFOCUS_SOURCE_DIR;
        fs::copy(source / "meshes/fish.glb", folder() / "other.glb");
        fs::copy(source / "docs/shot.schema.json", folder() / "schema.json");
        for (const fs::directory_entry& entry : fs::directory_iterator(folder()))
            given_.insert(entry.path().filename());
    }

    // Returns the exit code, the output, and the files that the command created.
    [[nodiscard]] std::string leftBy(const Words& line) const {
        const Outcome outcome = run(line);
        std::string text = std::to_string(outcome.exitCode) + " ";
        std::set<fs::path> files;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder()))
            if (!given_.contains(*fs::relative(entry.path(), folder()).begin())) files.insert(entry.path());
        for (const fs::path& path : files) {
            text += path.string() + " ";
            if (path.extension() == ".exr" || path.extension() == ".png") text += pixelsIn(path);
            if (path.extension() == ".usda") text += textOf(path);
            if (path.parent_path().filename() == "result" && path.extension() == ".json") {
                const json result = jsonIn(path);
                text += withoutTimes(result.at("rows")).dump() + std::to_string(result.value("runs", 0));
            }
        }
        if (line.front() == "bench") return text;  // the printed table contains times, so it is not compared
        static const std::regex times("[0-9.]+ m?s\\b|\"buildSeconds\": [0-9.e-]+");
        text += std::regex_replace(outcome.out, times, "");
        return text + (outcome.err.find("from earlier runs") != std::string::npos ? "kept" : "");
    }

    [[nodiscard]] std::string leftByCase(const std::string& command, const OwnOptionCase& tried, bool with) const {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder()))
            if (!given_.contains(entry.path().filename())) fs::remove_all(entry.path());
        for (const Words& line : tried.before) EXPECT_EQ(run(line).exitCode, 0) << shownLine(line);
        return leftBy(lineOfOwnCase(command, tried, with));
    }

private:
    std::set<fs::path> given_;
};

class EveryOwnOption : public OwnOption, public testing::WithParamInterface<std::string> {};

TEST_P(EveryOwnOption, acts) {
    const std::string& command = GetParam();
    for (const auto& [name, tried] : ownOptionCases()) {
        if (name.substr(0, name.rfind(' ')) != command) continue;
        const std::string without = leftByCase(command, tried, false);
        EXPECT_TRUE(without != leftByCase(command, tried, true))
            << name << " changes nothing in " << shownLine(lineOfOwnCase(command, tried, true));
    }
}

TEST_P(EveryOwnOption, isAllThatDiffers) {
    const OwnOptionCase nothing;
    EXPECT_TRUE(leftByCase(GetParam(), nothing, false) == leftByCase(GetParam(), nothing, false));
}

std::vector<std::string> commandsWithCases() {
    std::set<std::string> commands;
    for (const auto& [name, tried] : ownOptionCases()) commands.insert(name.substr(0, name.rfind(' ')));
    return {commands.begin(), commands.end()};
}

INSTANTIATE_TEST_SUITE_P(Of, EveryOwnOption, testing::ValuesIn(commandsWithCases()),
                         [](const auto& each) { return lettersOf(each.param); });

// ---- options with a test of their own -------------------------------------------------------------------------------

const Words quickRender = {"render", "ball.glb", "--size", "16x12", "--samples", "4"};

TEST_F(OwnOption, globalOnesAct) {
    const Outcome usual = run(quickRender);
    EXPECT_FALSE(usual.err.empty());
    EXPECT_EQ(run(joined(quickRender, {"--quiet"})).err, "");
    EXPECT_GT(run(joined(quickRender, {"--verbose"})).err.size(), usual.err.size());
    EXPECT_TRUE(run({"--version"}).out.starts_with("defocus "));
}

TEST_F(OwnOption, checkPrintsThePopsOfAFilm) {
    const Outcome outcome = run({"capture", "shot.json", "--check"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("level-of-detail pops in "), std::string::npos) << outcome.err;
}

TEST_F(OwnOption, shaderFolderIsReadOrRefused) {
    fs::create_directories(folder() / "shaders" / "accumulation");
    std::ofstream(folder() / "shaders" / "accumulation" / "object.frag") << "#version 450\nnot a shader\n";
    const auto with = [](const Words& line) { return joined(line, {"--shader-dir", "shaders"}); };
    for (const char* command : {"render", "capture", "bench speedup", "bench popping", "bench convergence"}) {
        const Outcome outcome = run(with(usualLine(command)));
        EXPECT_EQ(outcome.exitCode, 1) << command;
        EXPECT_NE(outcome.err.find("accumulation/object.frag"), std::string::npos) << command << outcome.err;
    }
    for (const Words& line : std::vector<Words>{usualLine("plan"),
                                                usualLine("info"),
                                                usualLine("pyramid"),
                                                usualLine("merge"),
                                                usualLine("refocus"),
                                                usualLine("compare"),
                                                {"bench", "stability"},
                                                {"cache", "list"},
                                                {"settings"}}) {
        const Outcome outcome = run(with(line));
        expectOneLine(outcome, 2);
        EXPECT_NE(outcome.err.find("--shader-dir"), std::string::npos) << outcome.err;
    }
}

// A program built from uncommitted sources refuses to write results of `defocus bench` without --allow-changed. The
// test works for builds from committed and uncommitted sources.
TEST_F(OwnOption, changedSourcesAreRefusedUnlessAllowed) {
    EXPECT_THROW(refuseChangedSources("out", false, "0123-changed"), Error);
    EXPECT_NO_THROW(refuseChangedSources("out", true, "0123-changed"));
    const bool changed = programCommit().ends_with("-changed");
    for (const char* command : {"bench speedup", "bench popping", "bench prediction", "bench convergence"}) {
        const Words line = withoutOption(usualLine(command), "--allow-changed");
        EXPECT_EQ(run(line).exitCode, changed ? 1 : 0) << command;
        fs::remove_all(folder() / "result");
        EXPECT_EQ(run(joined(line, {"--allow-changed"})).exitCode, 0) << command;
        fs::remove_all(folder() / "result");
    }
}

// `bench scaling` varies the scene property that --axes names. The test runs only the axis "blur", which takes seconds.
// --large adds larger scenes to the axis "triangles", which take minutes and are not run. The test checks that they are
// listed, and that --large without this axis is an error.
TEST_F(OwnOption, scalingGoesAlongItsAxis) {
    const Words line = {"bench", "scaling", "--axes", "blur", "--allow-changed"};
    // --runs defaults to three, so 1 proves that the option has an effect.
    ASSERT_EQ(run(joined(line, {"--runs", "1", "-o", "rows"})).exitCode, 0);
    ASSERT_EQ(run(joined(line, {"--runs", "1", "--report", "page"})).exitCode, 0);
    for (const char* made : {"rows", "page"}) {
        const json result = jsonIn(folder() / made / "scaling.json");
        ASSERT_FALSE(result.at("rows").empty());
        for (const json& row : result.at("rows")) EXPECT_EQ(row.at("axis"), "blur");
        EXPECT_EQ(result.at("runs"), 1);
    }
    const Outcome large = run(joined(line, {"--large"}));
    expectOneLine(large, 2);
    EXPECT_NE(large.err.find("--large"), std::string::npos) << large.err;
    EXPECT_GT(scalingPoints(ScalingAxis::triangles, true).size(), scalingPoints(ScalingAxis::triangles, false).size());
}

// All cases of `bench stability` together take minutes. Before the first case, the command therefore checks whether it
// can write its output file.
TEST_F(OwnOption, stabilityWritesWhereItIsTold) {
    for (const Words& output : std::vector<Words>{{"-o", "ball.glb/none.json"}, {"--report", "ball.glb/none"}}) {
        const Outcome outcome = run(joined({"bench", "stability", "--allow-changed"}, output));
        expectOneLine(outcome, 1);
        EXPECT_NE(outcome.err.find("ball.glb/none"), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace defocus::engine
