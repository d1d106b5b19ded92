// Compares the exposure meter with photographic practice: grey cards, snow, and a lamp in the dark.

#include "frame/setup/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

// Returns an image with one row for each grey value. The first `empty` rows have alpha 0.
Image stripes(const std::vector<float>& greys, std::size_t empty = 0) {
    Image image(10, static_cast<int>(greys.size()), 4);
    for (std::size_t y = 0; y < greys.size(); ++y)
        for (int x = 0; x < image.width; ++x) {
            float* pixel = image.at(x, static_cast<int>(y));
            pixel[0] = pixel[1] = pixel[2] = greys[y];
            pixel[3] = y < empty ? 0.0f : 1.0f;
        }
    return image;
}

TEST(Meter, aSceneOfManyGreysAveragesToMiddleGrey) {
    // The log average is 2 · 0.18, so the exposure is −1 EV. The brightest value is then 0.72. This is within its
    // limits, 40 % and 100 % of white, so the exposure is not adjusted.
    const Image image = stripes({0.09f, 0.36f, 1.44f});
    EXPECT_NEAR(meteredExposure(image), -1, 1e-6);
    // Multiplying the radiance by 2^10 lowers the exposure by 10 stops.
    EXPECT_NEAR(meteredExposure(stripes({0.09f * 1024, 0.36f * 1024, 1.44f * 1024})), -11, 1e-6);
}

TEST(Meter, highlightsStayBelowWhite) {
    std::vector<float> greys(9, 0.01f);
    greys.push_back(4);
    EXPECT_NEAR(meteredExposure(stripes(greys)), std::log2(1.0 / 4), 1e-6);
}

TEST(Meter, snowIsNoGreyCard) {
    EXPECT_NEAR(meteredExposure(stripes({0.9f, 0.9f})), std::log2(0.4 / 0.9), 1e-6);
}

TEST(Meter, aSingleFireflyCountsForNothing) {
    Image image = stripes(std::vector<float>(100, 0.18f));
    const double before = meteredExposure(image);
    image.at(3, 3)[0] = 1e5f;
    EXPECT_NEAR(meteredExposure(image), before, 0.03);
}

TEST(Meter, darkObjectBeforeALightBackgroundStaysDark) {
    // The object has a luminance of 2 %, and the background 80 %. A meter that ignored the background would raise the
    // object to 40 % of white, and the background to 16 times white.
    EXPECT_NEAR(meteredExposure(stripes({0.8f, 0.8f, 0.02f, 0.02f}, 2)), std::log2(0.5 / 0.8), 1e-6);
    EXPECT_NEAR(meteredExposure(stripes({0.1f, 1, 0.09f, 0.36f, 1.44f}, 2)), -1, 1e-6) << "a dark background";
}

TEST(Meter, darknessDoesNotCount) {
    EXPECT_NEAR(meteredExposure(stripes({0, 0.09f, 0.36f, 1.44f}, 1)), -1, 1e-6);
    EXPECT_EQ(meteredExposure(stripes({0, 0})), 0);
    EXPECT_EQ(meteredExposure(stripes({1, 1}, 2)), 0);
}

TEST(Meter, isReadForAllLightsButTheSchools) {
    Scene scene;
    Lens lens;
    Request request;
    EXPECT_FALSE(metersExposure(request, scene, lens));
    scene.lights.emplace_back();
    scene.school = true;
    EXPECT_FALSE(metersExposure(request, scene, lens)) << "the school's lights suit 0 EV";
    scene.school = false;
    EXPECT_TRUE(metersExposure(request, scene, lens));
    lens.exposureTime = 0.01;
    EXPECT_FALSE(metersExposure(request, scene, lens));
    request.exposure = MeteredExposure{};
    EXPECT_TRUE(metersExposure(request, scene, lens));
    request = {};
    request.exposure = ExposureValue{0};
    EXPECT_FALSE(metersExposure(request, scene, {}));
}

}  // namespace
}  // namespace defocus::engine
