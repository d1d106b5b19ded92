#include "core/suggestion.h"

#include <gtest/gtest.h>

namespace defocus {
namespace {

TEST(NearestWord, forgivesOneEditInThreeLetters) {
    const std::vector<std::string> known = {"render", "plan", "info", "compare"};
    EXPECT_EQ(nearestWord("rendr", known), "render");     // deletion
    EXPECT_EQ(nearestWord("erndre", known), "render");    // two swaps
    EXPECT_EQ(nearestWord("plaan", known), "plan");       // insertion
    EXPECT_EQ(nearestWord("conpere", known), "compare");  // two substitutions
    EXPECT_EQ(nearestWord("view", known), "");
    EXPECT_EQ(nearestWord("", known), "");
    EXPECT_EQ(nearestWord("anything", {}), "");
}

TEST(NearestWord, prefersTheNearer) {
    EXPECT_EQ(nearestWord("--fsto", {"--fish", "--fstop"}), "--fstop");
}

TEST(NearestWord, isNotSlowedByEndlessWords) {
    EXPECT_EQ(nearestWord(std::string(1 << 20, 'x'), {"plan"}), "");
}

}  // namespace
}  // namespace defocus
