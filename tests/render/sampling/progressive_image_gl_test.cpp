// Tests that an image that is drawn in blocks of samples equals an image drawn as one block, also in the viewer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gl/read_back.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "image/metrics.h"
#include "image/tone_map.h"
#include "likeness.h"
#include "render/accumulation/accumulation.h"
#include "render/display/display_pass.h"
#include "render/rendered.h"
#include "render/sampling/progressive_image.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

class Growing : public GlContextTest {
protected:
    void SetUp() override {
        SKIP_ON_SECOND_DRIVER();
        small_ = fiveCoarseSpheres();
        small_->view.lens.fStop = 1;
        small_->view.width = 64;
        small_->view.height = 48;
    }

    static RendererOptions options() { return {.layerFormat = LayerFormat::rgba32f}; }

    static RenderSettings settingsOf(std::uint32_t samples) { return {.sampleCount = samples}; }

    Image renderedAtOnce(std::uint32_t samples, LodMode lod) const {
        const RenderSettings settings{.sampleCount = samples, .lod = lod};
        const auto renderer = makeAccumulationRenderer(small_->world, options());
        return imageOf(*renderer, planFrame(small_->world, small_->view, settings));
    }

    ProgressiveImage progressive(const char* method = "accumulation") const {
        return {small_->world, parseMethodUse(method), options()};
    }
    // Replaces the spheres by spheres with enough triangles for several levels. The strong blur makes the error of few
    // samples larger than the error of coarse levels.
    void blurFineSpheres() {
        const View view = small_->view;
        small_ = fiveSpheres();
        small_->view = view;
        small_->view.lens.fStop = 0.5;
    }

    static Image grown(ProgressiveImage& image) {
        while (image.grow(1)) {
        }
        return readBack(*image.texture(), 4);
    }

    std::unique_ptr<SmallWorld> small_;
};

TEST_F(Growing, blocksAddUpToTheFrameRenderedAtOnce) {
    ProgressiveImage image = progressive();
    const RenderSettings settings{.lod = LodMode::off};
    image.begin(small_->view, settings, 192);
    EXPECT_FALSE(image.finished());
    const Image grownImage = grown(image);
    EXPECT_EQ(image.samples(), 192u);
    EXPECT_TRUE(sameBits(grownImage, renderedAtOnce(192, LodMode::off)));
}

TEST_F(Growing, firstBlockIsTheFrameOf64SamplesWithLevels) {
    blurFineSpheres();
    ProgressiveImage image = progressive();
    image.begin(small_->view, {}, 64);
    EXPECT_TRUE(std::ranges::any_of(image.plan().objects, [](const ObjectPlan& object) {
        return object.coarse.sampleCount > 0 || object.fine.level > 0;
    }));
    EXPECT_TRUE(sameBits(grown(image), renderedAtOnce(64, LodMode::fractional)));
}

TEST_F(Growing, levelsBecomeFinerWithTheSamples) {
    blurFineSpheres();
    ProgressiveImage image = progressive();
    image.begin(small_->view, {}, 256);
    const double first = static_cast<double>(image.plan().trianglesDrawn);
    grown(image);
    EXPECT_GT(static_cast<double>(image.plan().trianglesDrawn), 1.1 * first);
    EXPECT_EQ(image.plan().settings.firstSample, 192u);
    const RenderSettings own{.thresholds = {0.7, 3}};
    image.begin(small_->view, own, 128);
    grown(image);
    EXPECT_EQ(image.plan().thresholds.blur, 0.7);
}

TEST_F(Growing, viewWithoutBlurEndsWithItsFewSamples) {
    small_->view.lens.dofEnabled = false;
    ProgressiveImage image = progressive();
    image.begin(small_->view, {}, 4096);
    grown(image);
    EXPECT_EQ(image.samples(), antialiasingSamples);
    EXPECT_FALSE(image.grow(1));
}

TEST_F(Growing, postProcessMethodsEndWithTheirPinholes) {
    ProgressiveImage image = progressive("scheuermann:pinholes=2");
    image.begin(small_->view, {}, 4096);
    grown(image);
    EXPECT_EQ(image.samples(), 2u);
}

TEST_F(Growing, movingFramesAndStillOnesTakeTurns) {
    ProgressiveImage image = progressive();
    View smaller = small_->view;
    smaller.width = 32;
    smaller.height = 24;
    const RenderSettings settings = settingsOf(4);
    image.drawFrame(smaller, settings);
    EXPECT_EQ(image.samples(), 4u);
    EXPECT_EQ(image.texture()->info().width, 32);
    image.begin(small_->view, {}, 64);
    EXPECT_TRUE(sameBits(grown(image), renderedAtOnce(64, LodMode::fractional)));
    image.drawFrame(smaller, settings);
    EXPECT_EQ(image.samples(), 4u);
}

TEST_F(Growing, continuingIsRefusedWithinABlock) {
    const RenderSettings settings{.sampleCount = 32};
    const FramePlan plan = planFrame(small_->world, small_->view, settings);
    const auto renderer = makeAccumulationRenderer(small_->world, options());
    drawAllSamples(*renderer, plan);
    EXPECT_THROW(renderer->continueWith(plan), std::exception);
}

// The viewer displays the same values that an 8-bit image file would contain.
TEST_F(Growing, displayIsTheToneMapOfTheImage) {
    ProgressiveImage image = progressive();
    image.drawFrame(small_->view, settingsOf(8));
    const Image linear = readBack(*image.texture(), 4);
    DisplayPass display;
    for (const ToneMap toneMap : {ToneMap::none, ToneMap::aces, ToneMap::agx, ToneMap::neutral}) {
        DisplaySettings settings;
        settings.toneMap = toneMap;
        settings.exposure = 0.7;
        display.draw({.first = image.texture()}, settings, small_->view.width, small_->view.height);
        const Image shown = readBack(display.texture(), 3);
        const Image expected = displayEncoded(linear, toneMap, 0.7);
        double largest = 0;
        for (int y = 0; y < shown.height; ++y)
            for (int x = 0; x < shown.width; ++x)
                for (int c = 0; c < 3; ++c)
                    largest =
                        std::max(largest, std::abs(static_cast<double>(shown.at(x, y)[c]) - expected.at(x, y)[c]));
        EXPECT_LT(largest, 1.0 / 255) << static_cast<int>(toneMap);
    }
}

TEST_F(Growing, dividerPartsTheImages) {
    ProgressiveImage sharp = progressive();
    ProgressiveImage blurred = progressive();
    View pinhole = small_->view;
    pinhole.lens.dofEnabled = false;
    sharp.drawFrame(pinhole, settingsOf(16));
    blurred.drawFrame(small_->view, settingsOf(16));
    DisplayPass display;
    DisplaySettings settings;
    const auto shownAt = [&](double divider) {
        settings.divider = divider;
        display.draw({.first = sharp.texture(), .second = blurred.texture()}, settings, 64, 48);
        return readBack(display.texture(), 3);
    };
    const Image left = shownAt(1);
    const Image right = shownAt(0);
    const Image both = shownAt(0.5);
    EXPECT_FALSE(sameBits(left, right));
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(both.at(x, y)[c], (x < 32 ? left : right).at(x, y)[c]) << x << " " << y;
}

TEST_F(Growing, psnrIsThatOfCompare) {
    ProgressiveImage few = progressive();
    ProgressiveImage many = progressive();
    few.drawFrame(small_->view, settingsOf(4));
    many.drawFrame(small_->view, settingsOf(32));
    DisplayPass display;
    const double expected = compareImages(readBack(*many.texture(), 3), readBack(*few.texture(), 3)).psnr;
    EXPECT_NEAR(display.psnr(*many.texture(), *few.texture()), expected, 0.02);
    EXPECT_TRUE(std::isinf(display.psnr(*few.texture(), *few.texture())));
}

}  // namespace
}  // namespace defocus::engine
