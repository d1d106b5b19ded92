// Tests refocusing in the window, which keeps lens images (views from lens points) and computes images with another
// focus distance from them. Compares the results with images refocused by src/refocus, and with renders at the new
// focus distance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "frame/driver/scene_driver.h"
#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "gl/read_back.h"
#include "image/metrics.h"
#include "refocus/kept_lens_images.h"
#include "render/accumulation/accumulation.h"
#include "render/rendered.h"
#include "view/picture/kept_images.h"
#include "view/picture/view_picture.h"

namespace defocus::engine {
namespace {

constexpr double noLimit = std::numeric_limits<double>::infinity();
constexpr std::uint64_t muchMemory = 1ull << 30;

Request smallSchool() {
    Request request;
    request.fishCount = 9;  // fish at depths of 1 to 2.6 m
    request.trianglesPerFish = 500;
    request.noCache = true;
    request.size = {80, 60};
    request.lens.fStop = 0.95;
    request.lens.blurScale = 6;  // up to 10 px of blur
    request.focus = FocusDistance{2};
    return request;
}

// Returns the largest difference between values of two images; differences of values above 1 are relative.
double largestDifference(const Image& expected, const Image& image) {
    EXPECT_EQ(image.pixels.size(), expected.pixels.size());
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        largest = std::max(largest, std::abs(double(image.pixels[i]) - double(expected.pixels[i])) /
                                        std::max(1.0, double(expected.pixels[i])));
    return largest;
}

class KeptImagesOfAView : public testing::Test {
protected:
    KeptImagesOfAView() : view_(frame_.view) { request_.view = view_; }

    // Draws as many lens images (views from lens points) as fit into `bytes`, and returns them.
    KeptImages keptImages(std::uint64_t bytes = muchMemory, bool software = false) {
        KeptImages images(frame_.world, {}, software);
        images.begin(view_, frame_.settings, planFrame(frame_.world, view_, frame_.settings), bytes);
        images.grow(noLimit);
        return images;
    }

    Image refocused(KeptImages& images, double focusDistance, double fStop) {
        Lens lens = view_.lens;
        lens.focusDistance = focusDistance;
        lens.fStop = fStop;
        images.refocus(lens);
        return readBack(images.picture(), 4);
    }

    std::unique_ptr<GlContext> context_ = createHeadlessContext();
    PreparedFrame frame_ = prepareFrame(smallSchool());
    View view_;
    PictureRequest request_;
};

// The library draws and rounds its own lens images (views from lens points), and adds them on the CPU. Its refocused
// images equal those of the window.
TEST_F(KeptImagesOfAView, givePicturesOfTheLibrary) {
    Request request = smallSchool();
    request.method = "accumulation";
    request.samples = 64;
    FrameMoment moment = momentOf(frame_, request);
    moment.settings.sampleCount = 64;
    SceneDriver driver(frame_, request, {});
    std::optional<KeptLensImages> library;
    for (const bool software : {false, true}) {
        KeptImages images = keptImages(muchMemory, software);
        ASSERT_TRUE(images.complete()) << images.obstacle();
        EXPECT_EQ(images.drawn(), 64u);
        if (!library) library.emplace(driver, request, moment, images.info().range, [](double) {});
        for (const auto& [focus, fStop] : {std::pair(2.0, 0.95), std::pair(1.2, 0.95), std::pair(2.5, 1.4)}) {
            const double difference =
                largestDifference(sharpSum(*library, {focus, fStop}), refocused(images, focus, fStop));
            EXPECT_LE(difference, std::ldexp(1, -10)) << focus << " m, f/" << fStop;  // spacing of half floats near 1
        }
    }
}

TEST_F(KeptImagesOfAView, stayWithinTheirMemory) {
    for (const bool software : {false, true}) {
        KeptImages all = keptImages(muchMemory, software);
        const std::uint64_t each = all.bytes() / 64;
        KeptImages some = keptImages(20 * each + each / 2, software);
        EXPECT_EQ(some.drawn(), 20u);
        EXPECT_EQ(some.bytes(), 20 * each);
        const KeptImages none = keptImages(15 * each, software);
        EXPECT_EQ(none.planned(), 0u);
        EXPECT_EQ(none.bytes(), 0u);
        EXPECT_NE(none.obstacle().find("16 lens images"), std::string::npos) << none.obstacle();
    }
}

TEST_F(KeptImagesOfAView, areNotPlannedForALensThatDoesMoreThanMoveThem) {
    view_.lens.focusTilt = 0.1;
    const KeptImages images = keptImages();
    EXPECT_EQ(images.planned(), 0u);
    EXPECT_NE(images.obstacle().find("--focus-tilt"), std::string::npos) << images.obstacle();
}

TEST_F(KeptImagesOfAView, serveSmallerAperturesAndFocusDistancesInTheirRange) {
    const KeptImages images = keptImages();
    const auto serving = [&](double focusDistance, double fStop) {
        Lens lens = view_.lens;
        lens.focusDistance = focusDistance;
        lens.fStop = fStop;
        return images.serving(lens);
    };
    const FocusRange range = images.info().range;
    EXPECT_EQ(serving(2, 0.95), 64u);
    EXPECT_EQ(serving(range.nearest, 0.95), 64u);
    EXPECT_EQ(serving(range.nearest / 1.01, 0.95), 0u);
    EXPECT_EQ(serving(range.farthest * 1.01, 0.95), 0u);
    EXPECT_NEAR(serving(2, 0.95 * std::sqrt(2)), 32, 3);
    EXPECT_EQ(serving(2, 0.9), 0u);
    EXPECT_EQ(serving(2, 4), 0u);  // only about 4 of 64 lens points lie in the aperture; at least 16 are required
}

// Fixture whose window shows an image that no longer changes: all its lens images (views from lens points) are drawn.
class PictureAtRest : public KeptImagesOfAView {
protected:
    void SetUp() override {
        request_.settings = frame_.settings;
        request_.sides = {{"accumulation", LodMode::fractional, 0}};
        request_.imageBytes = muchMemory;
        request_.maxSamples = 128;
        rest();
        ASSERT_NE(picture_.keptImages(), nullptr);
        ASSERT_EQ(picture_.keptImages()->drawn(), 64u);
    }

    void draw() {
        picture_.grow(budget_);
        picture_.update(request_, budget_);
    }

    void rest() {
        do {
            draw();
            if (picture_.moving()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        } while (!picture_.idle());
    }

    Image render(std::uint32_t samples, std::uint32_t firstSample = 0) {
        RenderSettings settings = frame_.settings;
        settings.sampleCount = samples;
        settings.firstSample = firstSample;
        return imageOf(*makeAccumulationRenderer(frame_.world, {}), planFrame(frame_.world, request_.view, settings));
    }

    FrameBudget budget_;
    ViewPicture picture_{frame_.world, {}, false};
};

TEST_F(PictureAtRest, hasAnotherFocusInTheNextFrame) {
    for (const double focus : {1.2, 2.5}) {
        request_.view.lens.focusDistance = focus;
        draw();
        EXPECT_TRUE(picture_.refocused()) << focus;
        EXPECT_EQ(picture_.samples(), 64u) << focus;
        EXPECT_EQ(picture_.plan().view.lens.focusDistance, focus);
        const Image reference = render(256, 1 << 20);
        const double rendered = compareImages(reference, render(64)).psnr;
        const double refocused = compareImages(reference, picture_.image()).psnr;
        EXPECT_GT(refocused, 38) << focus;
        EXPECT_GT(refocused, rendered - 3) << focus;
    }
}

TEST_F(PictureAtRest, isReplacedOnceTheImageHasAsManySamples) {
    request_.view.lens.focusDistance = 1.4;
    draw();
    const Image refocused = picture_.image();
    while (picture_.refocused()) {
        EXPECT_EQ(picture_.samples(), 64u);
        EXPECT_EQ(picture_.image().pixels, refocused.pixels);
        draw();
    }
    EXPECT_GE(picture_.samples(), 64u);
    EXPECT_GT(compareImages(picture_.image(), refocused).psnr, 38);
    rest();
    EXPECT_EQ(picture_.samples(), 128u);
    request_.view.lens.focusDistance = 1.3;  // the kept views from lens points also cover this focus distance
    draw();
    EXPECT_TRUE(picture_.refocused());
}

TEST_F(PictureAtRest, answersASmallerApertureFromItsImages) {
    request_.view.lens.fStop = 1.2;
    draw();
    EXPECT_TRUE(picture_.refocused());
    EXPECT_NEAR(picture_.samples(), 64 * 0.95 * 0.95 / (1.2 * 1.2), 3);
    EXPECT_GT(compareImages(render(256, 1 << 20), picture_.image()).psnr, 36);
}

TEST_F(PictureAtRest, isDrawnForAWiderAperture) {
    request_.view.lens.fStop = 0.8;
    draw();
    EXPECT_FALSE(picture_.refocused());
    rest();
    EXPECT_EQ(picture_.keptImages()->info().fStop, 0.8);
}

TEST_F(PictureAtRest, losesItsImagesWithAnyOtherChange) {
    const PictureRequest begin = request_;
    const auto expectLoss = [&](const char* change) {
        draw();
        EXPECT_FALSE(picture_.refocused()) << change;
        EXPECT_EQ(picture_.keptImages()->drawn(), 0u) << change;
        EXPECT_EQ(picture_.keptImages()->bytes(), 0u) << change;
        request_ = begin;
        rest();
        EXPECT_EQ(picture_.keptImages()->drawn(), 64u) << change;
    };
    request_.view.worldFromCamera[3].x += 0.01;
    request_.view.lens.focusDistance = 1.4;
    expectLoss("camera");
    ++request_.poseVersion;
    expectLoss("pose");
    request_.view.lens.focalLength *= 1.1;
    expectLoss("focal length");
    request_.settingsKey = "other";
    expectLoss("settings");
}

TEST_F(PictureAtRest, keepsNoImagesWithoutMemory) {
    request_.imageBytes = 0;
    ++request_.poseVersion;
    rest();
    EXPECT_EQ(picture_.keptImages()->drawn(), 0u);
    request_.view.lens.focusDistance = 1.4;
    draw();
    EXPECT_FALSE(picture_.refocused());
}

}  // namespace
}  // namespace defocus::engine
