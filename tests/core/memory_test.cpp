#include "core/memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>

namespace defocus::engine {
namespace {

// A vector keeps its values while it grows and shrinks, which moves them between small blocks and entire pages.
TEST(Memory, aLargeVectorKeepsItsValuesWhateverItsSize) {
    struct alignas(64) Line {
        std::uint32_t number = 0;
    };
    LargeVector<Line> lines;
    constexpr std::size_t max = 4 * PageAllocator<Line>::fewestBytes / sizeof(Line);
    for (std::uint32_t i = 0; i < max; ++i) lines.push_back({i});
    const auto expectNumbers = [&] {
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            ASSERT_EQ(lines[i].number, i);
            ASSERT_EQ(reinterpret_cast<std::uintptr_t>(&lines[i]) % alignof(Line), 0u);
        }
    };
    expectNumbers();
    for (const std::size_t count : {max / 2, max / 64}) {
        lines.resize(count);
        lines.shrink_to_fit();
        EXPECT_EQ(lines.size(), count);
        expectNumbers();
    }
}

// Frees three quarters of a vector. Returns the fraction of its pages that the system still counts as resident.
double shareLeftOfAQuarter() {
    constexpr std::size_t page = 4096;
    constexpr std::size_t max = 4 * PageAllocator<std::uint32_t>::fewestBytes / sizeof(std::uint32_t);
    LargeVector<std::uint32_t> numbers(max);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::uint32_t* const place = numbers.data();
    numbers.resize(max / 4);
    giveBackRoom(numbers);
    EXPECT_EQ(numbers.data(), place);
    for (std::uint32_t i = 0; i < max / 4; ++i)
        if (numbers[i] != i) ADD_FAILURE() << "value " << i;
    std::vector<unsigned char> present(max * sizeof(std::uint32_t) / page);
    EXPECT_EQ(mincore(numbers.data(), present.size() * page, present.data()), 0);
    const auto count = std::count_if(present.begin(), present.end(), [](unsigned char p) { return (p & 1) != 0; });
    numbers.resize(max, 7);
    EXPECT_EQ(numbers.back(), 7u);
    return static_cast<double>(count) / static_cast<double>(present.size());
}

TEST(Memory, roomIsGivenBackAndValuesStay) {
    // Retries, since the system may merge pages into a huge page during an attempt, which makes freed pages resident
    // again.
    double min = 1;
    for (int attempt = 0; attempt < 20 && min > 0.26; ++attempt) min = std::min(min, shareLeftOfAQuarter());
    EXPECT_LE(min, 0.26);
}

TEST(Memory, whatNoMachineHasIsRefused) {
    PageAllocator<std::uint64_t> allocator;
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 16), std::bad_alloc);
}

// Returns the number of minor page faults of this thread so far.
long pageFaults() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt;
}

// Freed memory stays with the process, so that the images of each batch of samples reuse the memory of earlier images.
TEST(Memory, aFreedBlockIsUsedAgainWithoutPageFaults) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "needs glibc's malloc";
#endif
    keepFreedMemory();
    constexpr std::size_t bytes = std::size_t{96} << 20;
    constexpr std::size_t page = 4096;
    const auto faultsOfABlock = [&] {
        const long before = pageFaults();
        const auto block = std::make_unique_for_overwrite<char[]>(bytes);
        for (std::size_t i = 0; i < bytes; i += page) static_cast<volatile char*>(block.get())[i] = 1;
        return pageFaults() - before;
    };
    EXPECT_GT(faultsOfABlock(), 0);
    EXPECT_LT(faultsOfABlock(), static_cast<long>(bytes / page / 100));
}

}  // namespace
}  // namespace defocus::engine
