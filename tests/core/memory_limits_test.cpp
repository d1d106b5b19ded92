#include "core/memory_limits.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "core/error.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

TEST(MemoryLimits, amountsHaveDecimalAndBinaryUnits) {
    EXPECT_EQ(parseBytes("2GiB"), std::uint64_t{2} << 30);
    EXPECT_EQ(parseBytes("2 GB"), 2'000'000'000u);
    EXPECT_EQ(parseBytes("1.5MiB"), 1'572'864u);
    EXPECT_EQ(parseBytes("300M"), std::uint64_t{300} << 20);
    EXPECT_EQ(parseBytes("7B"), 7u);
    for (const char* wrong : {"", "GiB", "2", "2 gib", "-1GiB", "0B", "1e30GiB", "nan GiB", "2GiBs", "2 GiB "})
        EXPECT_THROW(parseBytes(wrong), Error) << wrong;
}

TEST(MemoryLimits, anAmountIsShownInTheUnitThatSuits) {
    EXPECT_EQ(bytesText(999), "999 B");
    EXPECT_EQ(bytesText(std::uint64_t{3} << 29), "1.5 GiB");
}

// Cached file pages of a control group count as free memory. The limit is 1,000 bytes, of which 900 are in use; 300 of
// these are inactive file pages.
TEST(MemoryLimits, filesThatWereReadDoNotUseUpAControlGroup) {
    const ScratchFolder folder;
    const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text << '\n'; };
    const auto left = [&](bool unified) { return leftByControlGroup(folder.path().string(), unified); };
    EXPECT_FALSE(left(true) || left(false));
    write("memory.max", "1000");
    write("memory.current", "900");
    EXPECT_EQ(left(true), 100u);
    write("memory.stat", "anon 400\nfile 500\nactive_file 200\ninactive_file 300\ntotal_inactive_file 100");
    EXPECT_EQ(left(true), 400u);
    write("memory.limit_in_bytes", "1000");
    write("memory.usage_in_bytes", "900");
    EXPECT_EQ(left(false), 200u);
    write("memory.current", "1300");  // usage can exceed the limit for a moment
    EXPECT_EQ(left(true), 0u);
    write("memory.max", "max");
    EXPECT_FALSE(left(true));
}

// Memory that this process writes to counts as resident and not as free.
TEST(MemoryLimits, residentMemoryGrowsByWhatIsTouched) {
    const std::uint64_t before = residentMemory();
    constexpr std::size_t bytes = std::size_t{64} << 20;
    const std::vector<char> touched(bytes, 1);
    EXPECT_GE(residentMemory(), before + bytes * 9 / 10) << touched.front();
    EXPECT_GT(freeMemory(), 0u);
}

}  // namespace
}  // namespace defocus::engine
