// Tests the report page of several benches in one folder.

#include <filesystem>
#include <string>

#include "cli/commands/bench_convergence.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

// One report page contains all benches whose results are in the folder: two benches that run here, and two with
// committed results.
TEST_F(BenchConvergence, reportHasASectionForEachBench) {
    fs::create_directory(folder() / "page");
    for (const char* name : {"scaling", "stability"})
        fs::copy(fs::path(DEFOCUS_SOURCE_DIR) / "bench/results" / (std::string("llvmpipe-") + name + ".json"),
                 folder() / "page" / (std::string(name) + ".json"));
    ASSERT_EQ(run({"--quiet", "bench", "speedup", "quads.gltf", "--counts", "2,4", "--size", "32x24", "--runs", "1",
                   "--report", "page", "--allow-changed"})
                  .exitCode,
              0);
    const Outcome outcome = run({"--quiet", "bench", "popping", "quads.gltf", "--counts", "2", "--size", "32x24",
                                 "--frames", "3", "--report", "page", "--allow-changed"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const char* file : {"speedup.csv", "speedup.json", "popping.csv", "popping.json"})
        EXPECT_TRUE(fs::exists(folder() / "page" / file)) << file;
    if (outcome.err.find("no report") != std::string::npos) GTEST_SKIP() << outcome.err;
    const std::string page = textOf(folder() / "page/index.html");
    expectSelfContained(page);
    for (const char* section : {"Speed-up", "Popping", "Scaling", "Stiff and extreme cases", "Blur against the lens"})
        EXPECT_NE(page.find(std::string(">") + section + "</h"), std::string::npos) << section;
    EXPECT_NE(page.find("defocus --quiet bench speedup quads.gltf --counts 2,4"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
