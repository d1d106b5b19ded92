#include "core/memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace defocus {
namespace {

// Small blocks and pages hand their values over to each other as a vector grows and shrinks.
TEST(Memory, aLargeVectorKeepsItsValuesWhateverItsSize) {
    struct alignas(64) Line {
        std::uint32_t number = 0;
    };
    LargeVector<Line> lines;
    constexpr std::size_t most = 4 * PageAllocator<Line>::fewestBytes / sizeof(Line);
    for (std::uint32_t i = 0; i < most; ++i) lines.push_back({i});
    const auto expectNumbers = [&] {
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            ASSERT_EQ(lines[i].number, i);
            ASSERT_EQ(reinterpret_cast<std::uintptr_t>(&lines[i]) % alignof(Line), 0u);
        }
    };
    expectNumbers();
    for (const std::size_t count : {most / 2, most / 64}) {
        lines.resize(count);
        lines.shrink_to_fit();
        EXPECT_EQ(lines.size(), count);
        expectNumbers();
    }
}

TEST(Memory, whatNoMachineHasIsRefused) {
    PageAllocator<std::uint64_t> allocator;
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 16), std::bad_alloc);
}

}  // namespace
}  // namespace defocus
