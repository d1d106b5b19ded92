// Tests that errors in the command line of `defocus bench` print one line on stderr.

#include "cli/commands/bench_commands.h"
#include "cli/program.h"
#include "cli/two_quads.h"
#include "core/error.h"

namespace defocus::engine {
namespace {

class Bench : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        writeTwoQuads(folder() / "quads.gltf");
    }

    void expectFault(int exitCode, const std::string& part, const std::vector<std::string>& arguments) const {
        std::vector<std::string> words = {"bench"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run(words);
        SCOPED_TRACE(arguments.back());
        expectOneLine(outcome, exitCode);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(fileCount(), 1u);
    }
};

TEST_F(Bench, convergenceRefusesListsThatAreNone) {
    const auto expectOf = [&](const std::string& part, const std::string& option, const std::string& value) {
        expectFault(2, part, {"convergence", "quads.gltf", option, value});
    };
    expectOf("1 to 65536", "--counts", "0");
    expectOf("'x'", "--counts", "4,x");
    expectOf("''", "--counts", "4,");
    expectOf("fractional", "--lod", "off,some");
    expectOf("size, error", "--metrics", "edges");
    expectOf("0 to 1000", "--threshold-factors", "1,-1");
    expectOf("1 to 1000", "--runs", "0");
    expectOf("2 to 65536", "--reference-samples", "1");
    expectOf("there is no method 'nothing'", "--methods", "accumulation,nothing");
    expectOf("x", "--methods", "accumulation:x=1");
    expectOf("lit", "--shading", "dim");
    expectFault(2, "--method",
                // bench convergence has the option --methods, not --method
                {"convergence", "quads.gltf", "--method", "accumulation"});
}

TEST_F(Bench, whatIsGivenTwiceIsNamed) {
    expectFault(2, "--counts is given 2 times; give it once",
                {"convergence", "quads.gltf", "--counts", "4", "--counts", "8"});
    expectFault(2, "--runs is given 3 times", {"scaling", "--runs", "1", "--runs", "2", "--runs", "3"});
    expectFault(2, "--output is given 2 times", {"speedup", "quads.gltf", "-o", "a", "-o", "b"});
}

TEST_F(Bench, convergenceLeavesNothingWhereItCannotBegin) {
    expectFault(1, "missing.glb", {"convergence", "missing.glb", "-o", "out"});
    expectFault(1, "quads.gltf", {"convergence", "quads.gltf", "-o", "quads.gltf", "--allow-changed"});
}

TEST(BenchResults, areNotWrittenFromChangedSources) {
    try {
        refuseChangedSources("out", false, "0123456789ab-changed");
        FAIL() << "an Error must be thrown";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("out: "), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("--allow-changed"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(refuseChangedSources("out", true, "0123456789ab-changed"));
    // Without an output folder, a build from uncommitted sources is accepted: the table is only printed to the
    // terminal.
    EXPECT_NO_THROW(refuseChangedSources("", false, "0123456789ab-changed"));
    EXPECT_NO_THROW(refuseChangedSources("out", false, "0123456789ab"));
    // an empty commit hash: the program was not built from a Git checkout
    EXPECT_NO_THROW(refuseChangedSources("out", false, ""));
}

}  // namespace
}  // namespace defocus::engine
