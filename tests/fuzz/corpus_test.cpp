// Runs the fuzz targets on inputs that once caused faults, and on the fuzzer's seeds.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <span>
#include <string>

#include "fuzz/targets.h"

namespace defocus::engine {

static void PrintTo(const FuzzTarget& target, std::ostream* stream) {
    *stream << target.name;
}

namespace {

class FuzzCorpus : public testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzCorpus, doesNoHarm) {
    const FuzzTarget& target = GetParam();
    const std::filesystem::path folder = std::filesystem::path(DEFOCUS_SOURCE_DIR) / "tests/fuzz/corpus" / target.name;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            SCOPED_TRACE(entry.path().string());
            std::ifstream file(entry.path(), std::ios::binary);
            const std::string bytes(std::istreambuf_iterator<char>(file), {});
            EXPECT_NO_THROW(target.run(std::as_bytes(std::span(bytes))));
        }
    const auto seeds = target.seeds();
    EXPECT_FALSE(seeds.empty());
    for (const auto& seed : seeds) EXPECT_NO_THROW(target.run(seed));
}

// Seeds truncated to each of eight lengths are accepted or rejected, without other exceptions or crashes.
TEST_P(FuzzCorpus, cutFilesDoNoHarm) {
    const FuzzTarget& target = GetParam();
    for (const auto& seed : target.seeds()) {
        if (seed.size() > target.maxBytes) continue;
        for (std::size_t part = 0; part < 8; ++part)
            EXPECT_NO_THROW(target.run(std::span(seed).first(seed.size() * part / 8)));
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, testing::ValuesIn(fuzzTargets().begin(), fuzzTargets().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace defocus::engine
