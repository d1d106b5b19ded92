#include "image/boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace defocus::engine {
namespace {

Image evenImage(int width, int height, float value) {
    Image image(width, height, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

TEST(BoxDifference, ofAnEvenShiftIsTheShift) {
    EXPECT_NEAR(boxDifference(evenImage(64, 48, 0.25f), evenImage(64, 48, 0.5f), 16), 0.25, 1e-12);
}

TEST(BoxDifference, seesNothingOfWhatABlurHides) {
    const Image reference = evenImage(64, 48, 0.5f);
    Image checkered = reference;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) checkered.at(x, y)[c] += (x + y) % 2 == 0 ? 0.5f : -0.5f;
    EXPECT_EQ(boxDifference(reference, checkered, 16), 0);
}

// The box difference is the root mean square over boxes and channels. Here one of 2 × 2 boxes differs by 0.4 in one of
// three channels.
TEST(BoxDifference, isTheRootOfTheMeanSquare) {
    const Image reference = evenImage(37, 32, 0);
    Image test = reference;
    for (int y = 0; y < 16; ++y)
        for (int x = 16; x < 32; ++x) test.at(x, y)[1] = 0.4f;
    for (int y = 0; y < 32; ++y) test.at(36, y)[0] = 100;  // pixels beyond the last complete box
    EXPECT_NEAR(boxDifference(reference, test, 16), 0.4 / std::sqrt(12.0), 1e-7);
}

}  // namespace
}  // namespace defocus::engine
