#include "core/memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

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

// Told by the system's own count of the pages that are there.
TEST(Memory, roomIsGivenBackAndValuesStay) {
    constexpr std::size_t page = 4096;
    constexpr std::size_t most = 4 * PageAllocator<std::uint32_t>::fewestBytes / sizeof(std::uint32_t);
    LargeVector<std::uint32_t> numbers(most);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::uint32_t* const place = numbers.data();
    numbers.resize(most / 4);
    giveBackRoom(numbers);
    EXPECT_EQ(numbers.data(), place);
    for (std::uint32_t i = 0; i < most / 4; ++i) ASSERT_EQ(numbers[i], i);
    std::vector<unsigned char> present(most * sizeof(std::uint32_t) / page);
    ASSERT_EQ(mincore(numbers.data(), present.size() * page, present.data()), 0);
    const auto count = std::count_if(present.begin(), present.end(), [](unsigned char p) { return (p & 1) != 0; });
    EXPECT_LE(static_cast<std::size_t>(count), present.size() / 4 + 1);
    numbers.resize(most, 7);
    EXPECT_EQ(numbers.back(), 7u);
}

TEST(Memory, whatNoMachineHasIsRefused) {
    PageAllocator<std::uint64_t> allocator;
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 16), std::bad_alloc);
}

}  // namespace
}  // namespace defocus
