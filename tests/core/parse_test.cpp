#include "core/parse.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"

namespace defocus::engine {
namespace {

std::string faultOf(const std::function<void()>& parse) {
    try {
        parse();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ParseNumber, takesTheWholeTextOrNothing) {
    const Range range{-1e3, 1e3};
    EXPECT_EQ(parseNumber("2.5", range), 2.5);
    EXPECT_EQ(parseNumber("-1e2", range), -100);
    EXPECT_EQ(parseNumber("+.5", range), 0.5);
    for (const char* text :
         {"", " ", "ten", "2m", "2 ", " 2", "0x10", "1,5", "nan", "-nan", "inf", "infinity", "1e999", "+-1", "++1"})
        EXPECT_NE(faultOf([&] { parseNumber(text, range); }), "") << text;
}

TEST(ParseNumber, keepsToItsRange) {
    const Range above{0, 10, true};
    EXPECT_EQ(parseNumber("10", above), 10);
    EXPECT_EQ(faultOf([&] { parseNumber("0", above); }), "'0' is not a number above 0 and at most 10");
    EXPECT_EQ(faultOf([&] { parseNumber("11", {0, 10}); }), "'11' is not a number from 0 to 10");
    EXPECT_EQ(parseNumber("0", {0, 10}), 0);
}

TEST(ParseWhole, refusesSignsFractionsAndOverflow) {
    EXPECT_EQ(parseInteger("65536", 1, 65'536), 65'536u);
    for (const char* text : {"", "-1", "1.5", "1e3", "65537", "0", "99999999999999999999999", "0x1", "1 "})
        EXPECT_NE(faultOf([&] { parseInteger(text, 1, 65'536); }), "") << text;
}

TEST(ParseNumbers, wantsExactlyTheirCount) {
    EXPECT_EQ(parseNumbers("0.1,2,3e0", 3, {0, 10}), (std::vector<double>{0.1, 2, 3}));
    for (const char* text : {"1,2", "1,2,3,4", "1,2,", ",1,2", "1,2,nan", "1,2,11", "1;2;3", ""})
        EXPECT_NE(faultOf([&] { parseNumbers(text, 3, {0, 10}); }), "") << text;
}

TEST(ParseChoice, listsTheChoicesAndSuggestsTheNearest) {
    const std::vector<std::string> choices = {"none", "aces", "agx"};
    EXPECT_EQ(parseChoice("agx", choices), 2u);
    EXPECT_EQ(faultOf([&] { parseChoice("aecs", choices); }),
              "'aecs' is not one of none, aces, agx; did you mean 'aces'?");
    EXPECT_EQ(faultOf([&] { parseChoice("filmic", choices); }), "'filmic' is not one of none, aces, agx");
    EXPECT_EQ(faultOf([&] { parseChoice("jeong", {"jeong2011"}); }), "'jeong' is not valid; the only choice is 'jeong2011'");
}

}  // namespace
}  // namespace defocus::engine
