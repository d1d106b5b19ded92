// The rasteriser against truth: an independent ray tracer on real geometry, and the closed forms of a small quad's
// bokeh. With DEFOCUS_TEST_OUTPUT set to a folder, images and their differences (× 16 around grey) are written there.

#include <gtest/gtest.h>

#include <cstdlib>

#include "bokeh.h"
#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "models.h"
#include "render/methods.h"
#include "truth_scene.h"

namespace defocus {
namespace {

Image rasterised(const World& world, const View& view, const RenderSettings& settings) {
    RendererOptions options;
    options.layerFormat = LayerFormat::rgba32f;
    const std::unique_ptr<Renderer> renderer = methodNamed("accumulation").make(world, options);
    return renderedImage(*renderer, planFrame(world, view, settings));
}

Image traced(const World& world, const View& view, const RenderSettings& settings,
             LensSharing sharing = LensSharing::perPixel) {
    FramePlan plan;
    plan.view = view;
    plan.settings = settings;
    return renderedImage(*makeEmbreeRenderer(world, sharing), plan);
}

void writeForPeople(const std::string& name, const Image& truth, const Image& image) {
    const char* folder = std::getenv("DEFOCUS_TEST_OUTPUT");
    if (folder == nullptr) return;
    const std::filesystem::path path(folder);
    writeImage(path / (name + "-embree.png"), truth);
    writeImage(path / (name + "-accumulation.png"), image);
    writeImage(path / (name + "-difference.png"), differenceImage(truth, image, 16));
}

void expectTruth(const std::string& name, Scene scene) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<TruthScene> truth = truthScene(std::move(scene), 512, 384);
    const RenderSettings settings = fullDetailSettings(256);
    const Image reference = traced(truth->world, truth->view, settings);
    const Image shared = traced(truth->world, truth->view, settings, LensSharing::shared);
    View widerLens = truth->view;
    widerLens.lens.fStop /= 1.05;
    const Image wider = traced(truth->world, widerLens, settings, LensSharing::shared);
    const Image image = rasterised(truth->world, truth->view, settings);
    writeForPeople(name, reference, image);

    const Difference difference = compareImages(reference, image);
    EXPECT_GE(difference.psnr, 45) << name;
    EXPECT_EQ(difference.nonFinite, 0) << name;
    // No structure: a lens shared by all pixels, as accumulation has it, leaves some banding, but no more than the ray
    // tracer's own images with a shared lens show.
    const BlockDifference allowed = blockDifference(reference, shared);
    const BlockDifference found = blockDifference(reference, image);
    EXPECT_LE(found.rms, 1.5 * allowed.rms) << name;
    EXPECT_LE(found.largest, 3 * allowed.largest) << name;
    EXPECT_LE(std::abs(found.mean), 2e-4) << name;
    // Nor a blur that is wider or narrower by a hundredth.
    const double widened = 0.05 * shareOfChange(reference, image, shared, wider);
    EXPECT_NEAR(widened, 0, 0.01) << name;
    // Nor an image that is moved or scaled: 256 Halton points have their mean up to 0.006 of the lens off its centre,
    // which moves a blur of 12 px radius by some hundredths of a pixel.
    const Misplacement moved = misplacement(reference, image);
    EXPECT_NEAR(moved.right, 0, 0.03) << name;
    EXPECT_NEAR(moved.down, 0, 0.03) << name;
    EXPECT_NEAR(moved.growth * truth->view.width, 0, 0.03) << name;  // px over the image's width
    std::printf(
        "%s: psnr=%.1f blockRms=%.2g (%.2g) blockLargest=%.2g (%.2g) mean=%.2g widened=%.4f moved=%.4f,%.4f "
        "grown=%.4f\n",
        name.c_str(), difference.psnr, found.rms, allowed.rms, found.largest, allowed.largest, found.mean, widened,
        moved.right, moved.down, moved.growth * truth->view.width);
}

TEST(Truth, FishSchoolEqualsTheRayTracer) {
    expectTruth("fish", fishSchool());
}

TEST(Truth, FlightHelmetEqualsTheRayTracer) {
    DEFOCUS_MODEL_OR_SKIP(path, "FlightHelmet/FlightHelmet.gltf");
    expectTruth("FlightHelmet", loadGltf(path));
}

TEST(Truth, SkullEqualsTheRayTracer) {
    DEFOCUS_MODEL_OR_SKIP(path, "skull.glb");
    expectTruth("skull", loadGltf(path));
}

struct BokehCase {
    const char* name;
    double depth;
    int bladeCount;
};

class TruthBokeh : public testing::TestWithParam<BokehCase> {};

TEST_P(TruthBokeh, SmallQuadHasTheRadiusOfTheFormulaAndTheEnergyOfThePinholeImage) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    View view = bokehView(128, 128);
    view.lens.bladeCount = GetParam().bladeCount;
    view.lens.bladeRotation = 0.3;
    const Rectangle quad{60.5, 62.5, 63.5, 65.5, GetParam().depth};
    const Scene scene = rectangleScene(view, {quad}, glm::vec3(100));
    World world = flatWorld(scene, blackBackground());
    for (const Mesh& mesh : scene.meshes) world.pyramids.push_back(fullDetail(mesh));
    const RenderSettings settings = fullDetailSettings(2048);

    const Moments blurred = momentsOf(rasterised(world, view, settings));
    EXPECT_NEAR(radiusBySecondMoment(blurred, GetParam().bladeCount, 3), blurDiameter(view, GetParam().depth) / 2, 0.5);
    EXPECT_NEAR(blurred.mean.x, 62, 0.1);
    EXPECT_NEAR(blurred.mean.y, 64, 0.1);
    view.lens.dofEnabled = false;
    const Moments sharp = momentsOf(rasterised(world, view, settings));
    EXPECT_NEAR(sharp.energy, 900, 900 * 0.005);
    EXPECT_NEAR(blurred.energy, sharp.energy, 0.005 * sharp.energy);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TruthBokeh,
                         testing::Values(BokehCase{"DiskInFront", 1.2, 0}, BokehCase{"DiskBehind", 6, 0},
                                         BokehCase{"HexagonInFront", 1.2, 6}, BokehCase{"HexagonBehind", 6, 6}),
                         [](const auto& test) { return test.param.name; });

TEST(TruthBokehShape, TriangleHasTheOrientationOfTheRayTracer) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    View view = bokehView(128, 128);
    view.lens.bladeCount = 3;
    view.lens.bladeRotation = 0.4;
    view.lens.anamorphicRatio = 1.5;
    const Scene scene = rectangleScene(view, {{38.5, 62.5, 41.5, 65.5, 6}, {90, 40, 93, 43, 1.2}}, glm::vec3(1));
    World world = flatWorld(scene, blackBackground());
    for (const Mesh& mesh : scene.meshes) world.pyramids.push_back(fullDetail(mesh));
    const RenderSettings settings = fullDetailSettings(1024);
    const Image reference = traced(world, view, settings);
    const Image image = rasterised(world, view, settings);
    EXPECT_GE(compareImages(reference, image).psnr, 45);
    writeForPeople("triangle", reference, image);
}

}  // namespace
}  // namespace defocus
