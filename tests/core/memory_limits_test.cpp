#include "core/memory_limits.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"

namespace defocus {
namespace {

TEST(MemoryLimits, amountsHaveDecimalAndBinaryUnits) {
    EXPECT_EQ(parseBytes("2GiB"), std::uint64_t{2} << 30);
    EXPECT_EQ(parseBytes("2 GB"), 2'000'000'000u);
    EXPECT_EQ(parseBytes("1.5MiB"), 1'572'864u);
    EXPECT_EQ(parseBytes("7B"), 7u);
    for (const char* wrong : {"", "GiB", "2", "2 gib", "-1GiB", "0B", "1e30GiB", "nan GiB", "2GiBs", "2 GiB "})
        EXPECT_THROW(parseBytes(wrong), Error) << wrong;
}

TEST(MemoryLimits, anAmountIsShownInTheUnitThatSuits) {
    EXPECT_EQ(bytesText(999), "999 B");
    EXPECT_EQ(bytesText(std::uint64_t{3} << 29), "1.5 GiB");
}

// What this process touches counts as resident, and no longer as free.
TEST(MemoryLimits, residentMemoryGrowsByWhatIsTouched) {
    const std::uint64_t before = residentMemory();
    constexpr std::size_t bytes = std::size_t{64} << 20;
    const std::vector<char> touched(bytes, 1);
    EXPECT_GE(residentMemory(), before + bytes * 9 / 10) << touched.front();
    EXPECT_GT(freeMemory(), 0u);
}

}  // namespace
}  // namespace defocus
