#include "image/text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace defocus::engine {
namespace {

struct Ink {
    double sum = 0;
    int left = 1'000'000;
    int right = -1;
    int top = 1'000'000;
    int bottom = -1;
};

constexpr float paper = 0.25f;
constexpr float inkValue = 0.75f;

Ink inkOf(const Image& image) {
    Ink ink;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double share = (double{image.at(x, y)[0]} - double{paper}) / double{inkValue - paper};
            EXPECT_GE(share, -1e-6);
            EXPECT_LE(share, 1 + 1e-6);
            ink.sum += share;
            if (share < 0.5) continue;
            ink.left = std::min(ink.left, x);
            ink.right = std::max(ink.right, x);
            ink.top = std::min(ink.top, y);
            ink.bottom = std::max(ink.bottom, y);
        }
    return ink;
}

class TextInImages : public ::testing::Test {
protected:
    void SetUp() override {
        Image probe(8, 8, 1);
        if (!writeText(probe, 0, 8, "x", 8, 1)) GTEST_SKIP() << "no readable font is installed";
    }
    static Image sheet() {
        Image image(400, 200, 3);
        std::fill(image.pixels.begin(), image.pixels.end(), paper);
        return image;
    }
    static Ink written(int x, int y, const char* text, int size) {
        Image image = sheet();
        EXPECT_TRUE(writeText(image, x, y, text, size, inkValue));
        return inkOf(image);
    }
};

TEST_F(TextInImages, StandsOnItsLineAndGrowsWithItsSize) {
    const Ink small = written(40, 150, "H", 40);
    EXPECT_NEAR(small.bottom, 149, 1);  // the letter ends in the row above the baseline
    // in sans-serif fonts, capital letters are 0.7 to 0.73 em tall
    EXPECT_NEAR(small.bottom - small.top, 0.72 * 40, 0.08 * 40);
    EXPECT_GE(small.left, 40);
    const Ink large = written(40, 150, "H", 80);
    EXPECT_NEAR(large.bottom - large.top, 2 * (small.bottom - small.top), 3);
    EXPECT_NEAR(large.sum, 4 * small.sum, 0.4 * large.sum);
}

TEST_F(TextInImages, ReadsUtf8) {
    // The two UTF-8 bytes of the degree sign give one glyph: a ring that stays in the upper half of a capital letter.
    const Ink degree = written(40, 150, "°", 40);
    EXPECT_LT(degree.bottom, 150 - 0.35 * 40);
    EXPECT_GT(degree.sum, 20);
    EXPECT_LT(degree.right - degree.left, 20);
    // Greek Alpha and Latin A have the same shape.
    EXPECT_NEAR(written(40, 150, "Α", 40).sum, written(40, 150, "A", 40).sum, 1);
    // An invalid UTF-8 byte is drawn as a question mark.
    EXPECT_NEAR(written(40, 150, "\xff", 40).sum, written(40, 150, "?", 40).sum, 1e-6);
}

TEST_F(TextInImages, WhatLiesOutsideIsLeftOut) {
    EXPECT_EQ(written(-500, 20, "HHH", 30).sum, 0);
    EXPECT_EQ(written(40, 900, "HHH", 30).sum, 0);
    const Ink cut = written(395, 150, "H", 40);
    EXPECT_LE(cut.right, 399);
    Image empty;
    EXPECT_TRUE(writeText(empty, 0, 0, "x", 10, 1));
}

}  // namespace
}  // namespace defocus::engine
