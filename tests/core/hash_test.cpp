// Tests the hash of cache keys and checksums: similar changes in several words do not cancel out.

#include "core/hash.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace defocus::engine {
namespace {

std::uint64_t hashOf(const std::vector<std::uint64_t>& words) {
    return hashBytes(std::as_bytes(std::span(words)));
}

// The hash is XXH3 and gives the values of the library's test vectors. If the values changed, stored keys would become
// invalid.
TEST(Hash, isXxh3) {
    EXPECT_EQ(hashBytes({}, 0), 0x2d06800538d394c2ull);
}

// Images and the built-in school of fish are reproducible only as long as these hash values do not change.
TEST(Hash, mixersKeepTheirValues) {
    EXPECT_EQ(fmix32(1), 0x514e28b7u);
    EXPECT_EQ(fmix32(0xffffffffu), 0x81f16f39u);
    EXPECT_EQ(lowbias32(1), 0x688990c0u);
    EXPECT_EQ(lowbias32(0xffffffffu), 0x6768824au);
}

// All combinations of flipped signs have different hashes. A chance collision is unlikely: among 10^5 random 64-bit
// values, its probability is below 3e-10.
TEST(Hash, flippedSignsOfFloatsNeverCancel) {
    constexpr std::size_t floats = 16;
    std::vector<float> values(floats, 1.5f);
    std::set<std::uint64_t> hashes;
    for (std::uint32_t signs = 0; signs < 1u << floats; ++signs) {
        for (std::size_t i = 0; i < floats; ++i) values[i] = (signs >> i & 1u) != 0 ? -1.5f : 1.5f;
        hashes.insert(hashBytes(std::as_bytes(std::span(values))));
    }
    EXPECT_EQ(hashes.size(), 1u << floats);
}

TEST(Hash, twoFlippedBitsNeverCancel) {
    std::vector<std::uint64_t> words(4, 0);
    std::set<std::uint64_t> hashes = {hashOf(words)};
    const std::size_t bits = 64 * words.size();
    for (std::size_t a = 0; a < bits; ++a)
        for (std::size_t b = a + 1; b <= bits; ++b) {  // if b == bits, only bit a is flipped
            words[a / 64] ^= 1ull << a % 64;
            if (b < bits) words[b / 64] ^= 1ull << b % 64;
            hashes.insert(hashOf(words));
            words.assign(words.size(), 0);
        }
    EXPECT_EQ(hashes.size(), 1 + bits * (bits + 1) / 2);
}

// Each input bit flips each output bit in about half of 2048 trials (standard deviation 23).
TEST(Hash, everyBitOfTheResultDependsOnEveryBit) {
    for (std::size_t bit = 0; bit < 128; ++bit) {
        std::vector<int> flips(64, 0);
        for (std::uint64_t trial = 0; trial < 2048; ++trial) {
            std::vector<std::uint64_t> words = {trial, 3 * trial};
            const std::uint64_t before = hashOf(words);
            words[bit / 64] ^= 1ull << bit % 64;
            const std::uint64_t changed = before ^ hashOf(words);
            for (std::size_t i = 0; i < 64; ++i) flips[i] += static_cast<int>(changed >> i & 1u);
        }
        for (const int count : flips) ASSERT_NEAR(count, 1024, 6 * 23) << bit;
    }
}

TEST(Hash, zerosAndLengthsCount) {
    const std::vector<std::byte> zeros(64, std::byte{0});
    std::set<std::uint64_t> hashes;
    for (std::size_t length = 0; length <= zeros.size(); ++length)
        hashes.insert(hashBytes(std::span(zeros).first(length)));
    EXPECT_EQ(hashes.size(), zeros.size() + 1);
    // Boundaries between strings that are hashed one after the other change the hash: "ab" + "" differs from "a" + "b".
    const auto pieces = [&](std::size_t first) {
        return hashBytes(std::span(zeros).first(16 - first), hashBytes(std::span(zeros).first(first)));
    };
    EXPECT_NE(pieces(8), pieces(16));
}

}  // namespace
}  // namespace defocus::engine
