// Tests that images do not depend on the number of drawing threads, and that frames can be abandoned or fail.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "gl_conduct.h"
#include "gl_context_test.h"
#include "likeness.h"
#include "plan/sample_range.h"
#include "render/accumulation/lens_cell_renders.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

class DrawingThreads : public GlContextTest {
protected:
    static RendererOptions inThreads(std::uint32_t threads, LayerFormat format = LayerFormat::rgba16f) {
        return {.layerFormat = format, .threads = threads};
    }
    // Renders `plan` with 1, 2 and 5 threads, and expects the same bits.
    static void expectSameBits(const char* method, const SmallWorld& small, const FramePlan& plan,
                               const char* description) {
        const Image expected = imageOf(*rendererOf(method, small.world, inThreads(1)), plan);
        for (const std::uint32_t threads : {2u, 5u}) {
            const auto renderer = rendererOf(method, small.world, inThreads(threads));
            EXPECT_TRUE(sameBits(expected, imageOf(*renderer, plan))) << description << ", " << threads << " threads";
            EXPECT_EQ(renderer->stats().threads, threads) << description;
            // A second frame uses the same threads.
            EXPECT_TRUE(sameBits(expected, imageOf(*renderer, plan))) << description << ", " << threads << " threads";
        }
    }
    static FramePlan planOf(const SmallWorld& small, std::uint32_t samples, LodMode lod = LodMode::fractional) {
        return planFrame(small.world, small.view, ratedSettings(samples, lod));
    }

    void SetUp() override {
        if (!drawsInThreads(currentDevice(), currentDriver())) GTEST_SKIP() << currentDriver() << " may crash";
    }
};

TEST_F(DrawingThreads, changeNoBitOfLevelsOfDetail) {
    const auto small = fiveSpheres();
    for (const LodMode lod : {LodMode::off, LodMode::fractional, LodMode::continuous})
        expectSameBits("accumulation", *small, planOf(*small, 70, lod), lodModeName(lod));
}

TEST_F(DrawingThreads, changeNoBitOfLensCells) {
    auto small = fiveSpheres();
    small->view.lens.fStop = 0.25;
    const FramePlan plan = planOf(*small, 200);
    ASSERT_GT(lensCells(plan).classes(), 1);
    for (const char* method : {"multirate", "auto"}) expectSameBits(method, *small, plan, method);
}

TEST_F(DrawingThreads, changeNoBitOfShadowsAndEnvironmentMaps) {
    const auto small = fiveSpheres();
    RenderSettings settings = ratedSettings(24);
    settings.shadows = Shadows::on;
    const FramePlan shadowed = planFrame(small->world, small->view, settings);
    ASSERT_FALSE(shadowed.shadows.maps.empty());
    expectSameBits("accumulation", *small, shadowed, "shadows");
    small->world.environment = speckledMap();
    expectSameBits("accumulation", *small, planOf(*small, 24), "map");
}

TEST_F(DrawingThreads, changeNoBitOfGlassAndBlendedSurfaces) {
    auto small = fiveSpheres();
    for (const bool transmits : {false, true}) {
        Material& material = small->scene.materials[0];
        material.alphaMode = transmits ? AlphaMode::opaque : AlphaMode::blend;
        material.baseColorFactor.a = transmits ? 1.0f : 0.5f;
        material.transmissionFactor = transmits ? 1.0f : 0.0f;
        material.roughnessFactor = 0.4f;
        expectSameBits("accumulation", *small, planOf(*small, 24), transmits ? "glass" : "blended");
    }
}

TEST_F(DrawingThreads, changeNoBitOfDataLayers) {
    const auto small = fiveSpheres();
    RenderSettings settings = ratedSettings(70);
    settings.layers = {Layer::depth, Layer::normal, Layer::objects};
    const FramePlan plan = planFrame(small->world, small->view, settings);
    const auto layersIn = [&](std::uint32_t threads) {
        const auto renderer = rendererOf("accumulation", small->world, inThreads(threads));
        imageOf(*renderer, plan);
        return renderer->layerImages().value();
    };
    const LayerImages expected = layersIn(1);
    for (const std::uint32_t threads : {2u, 5u}) {
        const LayerImages images = layersIn(threads);
        for (const auto& [layer, image] : expected.means)
            EXPECT_TRUE(sameBits(image, images.means.at(layer))) << static_cast<int>(layer);
        EXPECT_TRUE(sameBits(expected.nearestDepth, images.nearestDepth));
        EXPECT_TRUE(sameBits(expected.numbers.at(Layer::objects).values, images.numbers.at(Layer::objects).values));
    }
}

// After each batch (wave) of samples, the image is the mean of all samples so far, while threads already draw further
// samples.
TEST_F(DrawingThreads, changeNoBitOfUnfinishedImages) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small, 32);
    const auto one = rendererOf("accumulation", small->world, inThreads(1));
    one->setWave({.samples = 1});
    const auto five = rendererOf("accumulation", small->world, inThreads(5));
    one->start(plan);
    five->start(plan);
    for (bool more = true; more;) {
        more = five->advance();
        while (one->samples() < five->samples()) one->advance();
        ASSERT_TRUE(sameBits(one->image(), five->image())) << five->samples() << " samples";
    }
    EXPECT_EQ(five->samples(), 32u);
}

TEST_F(DrawingThreads, blocksCanBeAddedToTheSum) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small, 128);
    const auto renderer = rendererOf("accumulation", small->world, inThreads(3));
    const auto drawAll = [&] {
        while (renderer->advance()) {
        }
    };
    renderer->start(samplesOf(plan, 0, 64));
    drawAll();
    renderer->continueWith(samplesOf(plan, 64, 64));
    drawAll();
    EXPECT_EQ(renderer->samples(), 128u);
    EXPECT_TRUE(sameBits(imageOf(*rendererOf("accumulation", small->world, inThreads(1)), plan), renderer->image()));
}

// A frame is drawn by at most as many threads as it has samples.
TEST_F(DrawingThreads, areAtMostTheSamples) {
    const auto small = fiveSpheres();
    const auto renderer = rendererOf("accumulation", small->world, inThreads(5));
    for (const std::uint32_t samples : {3u, 1u, 20u}) {
        const FramePlan plan = planOf(*small, samples);
        const Image expected = imageOf(*rendererOf("accumulation", small->world, inThreads(1)), plan);
        EXPECT_TRUE(sameBits(expected, imageOf(*renderer, plan))) << samples;
        EXPECT_EQ(renderer->stats().threads, std::min(samples, 5u));
    }
}

// A limit on the number of samples that are drawn together applies to all threads in total, so it also limits the
// number of threads.
TEST_F(DrawingThreads, keepToTheLimitOfLayers) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small, 64);
    const auto statsWith = [&](std::uint32_t threads, std::uint32_t layers) {
        RendererOptions options = inThreads(threads);
        options.wave = layers;
        const auto renderer = rendererOf("accumulation", small->world, options);
        imageOf(*renderer, plan);
        return renderer->stats();
    };
    const std::uint64_t layerBytes = statsWith(1, 2).peakBytes - statsWith(1, 1).peakBytes;
    for (const std::uint32_t layers : {1u, 3u, 4u, 9u}) {
        const RenderStats stats = statsWith(4, layers);
        EXPECT_EQ(stats.threads, std::min(layers, 4u));
        // The peak memory of statsWith(1, 1) already includes one layer. The bound thus leaves the memory of one layer
        // for the threads' uniform buffers.
        EXPECT_LE(stats.peakBytes, statsWith(1, 1).peakBytes + layers * layerBytes) << layers;
    }
}

TEST_F(DrawingThreads, framesCanBeAbandoned) {
    const auto small = fiveSpheres();
    const FramePlan plan = planOf(*small, 70);
    const Image expected = imageOf(*rendererOf("accumulation", small->world, inThreads(1)), plan);
    auto renderer = rendererOf("accumulation", small->world, inThreads(3));
    for (const int waves : {0, 1, 5}) {
        renderer->start(plan);
        for (int i = 0; i < waves; ++i) renderer->advance();
        EXPECT_TRUE(sameBits(expected, imageOf(*renderer, plan))) << waves;
    }
    renderer->start(plan);
    renderer->advance();
    renderer.reset();  // destroys the renderer while threads draw
}

// If a thread fails to compile a shader, the caller gets the error, and the next frame is drawn.
TEST_F(DrawingThreads, errorsReachTheCaller) {
    const ExpectedGlMessages broken;
    const auto small = fiveSpheres();
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "accumulation");
    const auto messageWith = [&](const char* shader) {
        std::ofstream(folder / shader) << "broken";
        RendererOptions options = inThreads(3);
        options.shaderFolder = folder.path();
        const auto renderer = rendererOf("accumulation", small->world, options);
        std::string message;
        try {
            imageOf(*renderer, planOf(*small, 70));
        } catch (const Error& error) {
            message = error.what();
        }
        std::filesystem::remove(folder / shader);
        EXPECT_FALSE(imageOf(*renderer, planOf(*small, 70)).empty());
        return message;
    };
    EXPECT_NE(messageWith("accumulation/object.vert").find("accumulation/object.vert"), std::string::npos);
    auto map = std::make_shared<Image>(16, 8, 3);
    // with a map, each thread compiles the sky's shader for its first sample
    small->world.environment.type = EnvironmentType::map;
    small->world.environment.map = map;
    EXPECT_NE(messageWith("accumulation/sky.frag").find("accumulation/sky.frag"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
