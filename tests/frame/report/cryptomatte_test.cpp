// Compares Cryptomatte's hashes and ids with published values, and its masks with pixel coverage computed by hand.

#include "frame/report/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "core/hash.h"

namespace defocus::engine {
namespace {

// Compares hashes with values of the reference implementation (Appleby, SMHasher).
TEST(MurmurHash, agreesWithTheReference) {
    EXPECT_EQ(murmurHash3(""), 0u);
    EXPECT_EQ(murmurHash3("test"), 0xba6bd213u);
    EXPECT_EQ(murmurHash3("Hello, world!"), 0xc0363e43u);
    EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

// Compares ids with values from the tests of Psyop's Cryptomatte for Nuke.
TEST(CryptomatteId, agreesWithOtherPrograms) {
    EXPECT_FLOAT_EQ(cryptomatteId("hello"), 6.0705627102400005616e-17f);
    EXPECT_FLOAT_EQ(cryptomatteId("cube"), -4.08461912519e+15f);
    EXPECT_FLOAT_EQ(cryptomatteId("sphere"), 2.79018604383e+15f);
    EXPECT_FLOAT_EQ(cryptomatteId("plane"), 3.66557617593e-11f);
}

TEST(CryptomatteId, isAlwaysAPlainNumber) {
    for (int i = 0; i < 20'000; ++i) {
        const std::uint32_t exponent = std::bit_cast<std::uint32_t>(cryptomatteId(std::to_string(i))) >> 23 & 255;
        ASSERT_TRUE(exponent != 0 && exponent != 255) << i;
    }
}

TEST(Cryptomatte, sortsByCoverageAndMergesEqualNames) {
    const auto entry = [](std::uint32_t number, std::uint32_t count) { return number << 16 | count; };
    const NumberCounts counts{2, 1, 4, {entry(1, 3), entry(2, 10), entry(3, 2), entry(4, 1), 0, 0, 0, 0}};
    Image samples(2, 1, 1);
    samples.pixels = {16, 16};
    const Cryptomatte matte = cryptomatte(counts, samples, {"a", "b", "c", "a"});
    ASSERT_EQ(matte.ranks.size(), 3u);
    const auto expectRank = [&](int rank, const char* name, float coverage) {
        const float* pixel = matte.ranks[static_cast<std::size_t>(rank / 2)].at(0, 0) + 2 * (rank % 2);
        EXPECT_EQ(pixel[0], cryptomatteId(name)) << rank;
        EXPECT_FLOAT_EQ(pixel[1], coverage) << rank;
    };
    expectRank(0, "b", 10 / 16.0f);
    expectRank(1, "a", 4 / 16.0f);
    expectRank(2, "c", 2 / 16.0f);
    for (const Image& image : matte.ranks)
        for (int c = 0; c < 4; ++c) EXPECT_EQ(image.at(1, 0)[c], 0) << "no object covers the second pixel";
    EXPECT_EQ(nlohmann::json::parse(matte.manifest).at("a"),
              fmt::format("{:08x}", std::bit_cast<std::uint32_t>(cryptomatteId("a"))));
}

TEST(Cryptomatte, hasTheMetadataOfTheSpecification) {
    Metadata metadata;
    addCryptomatteMetadata("CryptoObject", "{}", metadata);
    EXPECT_EQ(metadata.size(), 4u);
    EXPECT_EQ(std::get<std::string>(metadata.at("cryptomatte/3ae39a5/name")), "CryptoObject");
    EXPECT_EQ(std::get<std::string>(metadata.at("cryptomatte/3ae39a5/hash")), "MurmurHash3_32");
    EXPECT_EQ(std::get<std::string>(metadata.at("cryptomatte/3ae39a5/conversion")), "uint32_to_float32");
    EXPECT_EQ(std::get<std::string>(metadata.at("cryptomatte/3ae39a5/manifest")), "{}");
}

}  // namespace
}  // namespace defocus::engine
