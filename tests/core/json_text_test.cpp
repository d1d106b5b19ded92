#include "core/json_text.h"

#include <gtest/gtest.h>

#include <string>

namespace defocus::engine {
namespace {

TEST(JsonNesting, countsArraysAndObjectsOutsideOfText) {
    EXPECT_EQ(jsonNesting(""), 0);
    EXPECT_EQ(jsonNesting("3"), 0);
    EXPECT_EQ(jsonNesting(R"({"a": [1, {"b": []}], "c": [[]]})"), 4);
    EXPECT_EQ(jsonNesting(R"(["[[[", "\"[[", "\\"])"), 1);
    EXPECT_EQ(jsonNesting(std::string(100'000, '[')), 100'000);
}

}  // namespace
}  // namespace defocus::engine
