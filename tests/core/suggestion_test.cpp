#include "core/suggestion.h"

#include <gtest/gtest.h>

namespace defocus::engine {
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

TEST(NearestWord, findsThePartOfAName) {
    EXPECT_EQ(nearestWord("eye", {"Right eye lid", "Left eye"}), "Left eye");
    EXPECT_EQ(nearestWord("ey", {"Left eye"}), "") << "too short to be meant";
}

TEST(NearestWord, ignoresCapitals) {
    EXPECT_EQ(nearestWord("FIS 1", {"Fish 1", "Camera"}), "Fish 1");
}

TEST(PlaceOfName, takesTheNameItselfFirst) {
    const std::vector<std::string> known = {"fox", "Fox", "Tree"};
    EXPECT_EQ(placeOfName("Fox", known), 1u);
    EXPECT_EQ(placeOfName("fox", known), 0u);
    EXPECT_EQ(placeOfName("FOX", known), std::nullopt) << "ambiguous: two names differ only in case";
    EXPECT_EQ(placeOfName("tree", known), 2u);
    EXPECT_EQ(placeOfName("trees", known), std::nullopt);
    EXPECT_EQ(placeOfName("FISH", {"Fish", "Fish"}), 0u) << "the first of two equal names";
}

TEST(NearestWord, isNotSlowedByEndlessWords) {
    EXPECT_EQ(nearestWord(std::string(1 << 20, 'x'), {"plan"}), "");
}

}  // namespace
}  // namespace defocus::engine
