// Tests images in which each lens sample is drawn at four positions in each pixel instead of one
// (RenderSettings::positions).

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "image/metrics.h"
#include "likeness.h"
#include "plan/visible/tiles.h"
#include "render/accumulation/lens_cell_renders.h"
#include "render/frame_run.h"
#include "render/sampling/automatic_samples.h"

namespace defocus::engine {
namespace {

class Positions : public LensCellImages {
protected:
    static RenderSettings settingsWith(std::uint32_t positions, std::uint32_t samples) {
        RenderSettings settings = ratedSettings(samples);
        settings.positions = positions;
        return settings;
    }

    // Returns a reference image of 1,024 samples, whose sample sequence differs from that of the tested images.
    static Image referenceOf(const SmallWorld& small) {
        RenderSettings settings = ratedSettings(1024);
        settings.sequence = Sequence::halton;
        return drawnBy("accumulation", small, settings);
    }

    // Returns the image at half its width and height. Each pixel is the mean of 2 × 2 pixels.
    static Image halved(const Image& image) {
        Image half(image.width / 2, image.height / 2, image.channels);
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < half.channels; ++c)
                    half.at(x, y)[c] = (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                                        image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c]) /
                                       4;
        return half;
    }
};

// With four positions per pixel, each pixel is the mean of 2 × 2 pixels of an image of twice the width and height.
TEST_F(Positions, areThePixelsOfATwiceAsLargeImage) {
    const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
    for (const bool curvedFocus : {false, true}) {
        const auto small = fiveCoarseSpheres();
        small->view.lens.fieldCurvature = curvedFocus ? 1 : 0;
        const Image image = drawnBy("accumulation", *small, settingsWith(4, 20), exact);
        small->view.width *= 2;
        small->view.height *= 2;
        const Image twice = halved(drawnBy("accumulation", *small, settingsWith(1, 20), exact));
        EXPECT_LT(largestDifference(image, twice), 1e-5) << "field curvature " << curvedFocus;
    }
}

// A blurred square has the colour of the background, so the image must be constant.
TEST_F(Positions, doNotChangeAConstantPicture) {
    const auto small = std::make_unique<SmallWorld>();
    small->scene.materials.push_back(unlitMaterial({0.1f, 0.7f, 1.0f / 3, 1}));
    small->scene.meshes.push_back(quad(0));
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -1)), glm::dvec3(0.2)));
    small->view.width = 96;
    small->view.height = 64;
    small->view.lens.fStop = 0.25;
    small->view.lens.focusDistance = 2;
    finish(*small);
    small->world.environment = {EnvironmentType::uniform, {0.1f, 0.7f, 1.0f / 3}, {}, {}, nullptr, 1};
    const RendererOptions exact{.layerFormat = LayerFormat::rgba32f};
    for (const char* method : {"accumulation", "multirate"}) {
        const Image image = drawnBy(method, *small, settingsWith(4, 20), exact);
        EXPECT_LT(relativeDifferenceFrom(image, {0.1f, 0.7f, 1.0f / 3}), 1e-6) << method;
    }
}

TEST_F(Positions, convergeToTheSamePicture) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = blurredSpheres();
    small->view.width = 48;
    small->view.height = 36;
    small->view.lens.fStop = 0.25;
    const Image reference = referenceOf(*small);
    for (const char* method : {"accumulation", "multirate"}) {
        const auto errorOf = [&](std::uint32_t positions, std::uint32_t samples) {
            return compareImages(reference, drawnBy(method, *small, settingsWith(positions, samples))).rmse;
        };
        for (const std::uint32_t samples : {16u, 64u})
            EXPECT_LT(errorOf(4, samples), errorOf(1, samples)) << method << ", " << samples;
        EXPECT_LT(errorOf(4, 256), 0.5 * errorOf(4, 16)) << method;
    }
}

TEST_F(Positions, ofAnyWaveOrTileHaveTheSameBits) {
    const auto small = fiveCoarseSpheres();
    small->scene.materials[0].alphaMode = AlphaMode::blend;
    small->scene.materials[0].baseColorFactor.a = 0.6f;
    const FramePlan plan = planFrame(small->world, small->view, settingsWith(4, 20));
    const Image image = imageOf(*rendererOf("accumulation", small->world), plan);
    for (const std::uint32_t wave : {1u, 3u}) {
        const RendererOptions options{.wave = wave};
        EXPECT_TRUE(sameBits(image, imageOf(*rendererOf("accumulation", small->world, options), plan))) << wave;
    }
    const Tile tile{{17, 6, 33, 26}, {0, 0, plan.view.width, plan.view.height}};
    const Image part = imageOf(*rendererOf("accumulation", small->world), tileOf(plan, tile));
    ASSERT_EQ(part.width, tile.area.width);
    ASSERT_EQ(part.height, tile.area.height);
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(part.at(x, y)[c], image.at(tile.area.left + x, tile.area.top + y)[c]) << x << ", " << y;
}

TEST_F(Positions, keepDepthsInTheSizeOfTheImage) {
    const auto small = fiveSpheres();
    const auto renderer = rendererOf("accumulation", small->world);
    static_cast<void>(imageOf(*renderer, planFrame(small->world, small->view, settingsWith(4, 1))));
    const Image depth = renderer->sampleDepth().value();
    EXPECT_EQ(depth.width, small->view.width);
    EXPECT_EQ(depth.height, small->view.height);
    EXPECT_NEAR(*depth.at(depth.width * 2 / 7, depth.height * 4 / 7), 1.1, 0.2) << "the nearest sphere";
}

TEST_F(Positions, otherThanOneOrFourAreRefused) {
    const auto small = fiveSpheres();
    EXPECT_THROW(static_cast<void>(planFrame(small->world, small->view, settingsWith(2, 16))), Error);
    RenderSettings layers = settingsWith(4, 16);
    layers.layers = {Layer::depth};
    EXPECT_THROW(static_cast<void>(planFrame(small->world, small->view, layers)), Error);
}

// With an automatic number of samples, the renderer chooses four positions per pixel if the blur is small but not zero.
TEST_F(Positions, areChosenByTheBlur) {
    const auto small = fiveSpheres();
    small->view.width = 64;
    small->view.height = 48;
    const auto renderer = rendererOf("auto", small->world);
    const auto drawn = [&](bool mayChoose) {
        FrameRun run(small->world, *renderer);
        run.start(small->view, ratedSettings(64), {.automatic = Quality::draft, .choosesPositions = mayChoose});
        while (run.advance()) {
        }
        return run.plan().settings;
    };
    EXPECT_EQ(drawn(false).positions, 1u);
    const RenderSettings few = drawn(true);
    EXPECT_EQ(few.positions, 4u);
    EXPECT_LE(few.sampleCount, 16u);
    EXPECT_TRUE(sameBits(renderer->image(), drawnBy("accumulation", *small, settingsWith(4, few.sampleCount))));
    small->view.lens.fStop = 0.25;
    EXPECT_EQ(drawn(true).positions, 1u) << "much blur";
    small->view.lens.fStop = 120;
    EXPECT_EQ(drawn(true).positions, 1u) << "a pinhole";
}

// Rough glass blurs the objects behind it equally with one and with four positions per pixel.
TEST_F(Positions, doNotSharpenRoughGlass) {
    const auto small = fiveCoarseSpheres();
    small->scene.materials[0].transmissionFactor = 1;
    small->scene.materials[0].roughnessFactor = 0.5f;
    small->view.lens.fStop = 8;
    RenderSettings one = settingsWith(1, 64), four = settingsWith(4, 64);
    one.keepAll = four.keepAll = true;
    const Image image = drawnBy("accumulation", *small, one);
    EXPECT_GT(compareImages(image, drawnBy("accumulation", *small, four)).psnr, 40);
}

// If lens samples have four positions per pixel, the renderer draws samples until the estimated error is as small as
// the chosen quality requires, as with one position.
TEST_F(Positions, areDrawnUntilTheQualityIsReached) {
    SKIP_ON_SECOND_DRIVER();
    const auto small = fiveCoarseSpheres();
    small->view.lens.fStop = 1;
    small->view.width = 64;
    small->view.height = 48;
    const Image reference = referenceOf(*small);
    const auto renderer = rendererOf("auto", small->world);
    std::vector<std::uint32_t> samples;
    for (const Quality quality : {Quality::draft, Quality::good, Quality::fine}) {
        FrameRun run(small->world, *renderer);
        run.start(small->view, ratedSettings(64), {.automatic = quality, .choosesPositions = true});
        while (run.advance()) {
        }
        EXPECT_EQ(run.plan().settings.positions, 4u);
        EXPECT_TRUE(run.plan().usesLens);
        samples.push_back(run.samples());
        EXPECT_LT(compareImages(reference, renderer->image()).flip, 1.2 * flipOf(quality));
    }
    EXPECT_TRUE(std::ranges::is_sorted(samples));
    EXPECT_LT(samples.front(), samples.back());
}

}  // namespace
}  // namespace defocus::engine
