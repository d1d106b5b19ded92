// Compares base64 encoding with the test vectors of RFC 4648, section 10.

#include "core/base64.h"

#include <gtest/gtest.h>

#include <string_view>

namespace defocus::engine {
namespace {

TEST(Base64, encodesTheVectorsOfTheStandard) {
    const auto encoded = [](std::string_view text) { return base64(std::as_bytes(std::span(text))); };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace defocus::engine
