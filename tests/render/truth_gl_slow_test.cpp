// Tests the rasterizer against an independent ray tracer on real geometry, and against closed forms of a small quad's
// bokeh. If DEFOCUS_TEST_OUTPUT names a folder, images and their differences, scaled by 16 and centred on grey, are
// written there.

#include <gtest/gtest.h>

#include <cstdlib>

#include "bokeh.h"
#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "models.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "truth_scene.h"

namespace defocus::engine {
namespace {

Image rasterised(const World& world, const View& view, const RenderSettings& settings) {
    const RendererOptions options{.layerFormat = LayerFormat::rgba32f};
    const std::unique_ptr<Renderer> renderer = makeAccumulationRenderer(world, options);
    return imageOf(*renderer, planFrame(world, view, settings));
}

Image traced(const World& world, const View& view, const RenderSettings& settings,
             EmbreeSampling sampling = EmbreeSampling::perPixel) {
    FramePlan plan;
    if (sampling == EmbreeSampling::planned) plan = planFrame(world, view, settings);
    plan.view = view;
    plan.settings = settings;
    return imageOf(*makeEmbreeRenderer(world, sampling), plan);
}

void writeForPeople(const std::string& name, const Image& reference, const Image& image) {
    const char* folder = std::getenv("DEFOCUS_TEST_OUTPUT");
    if (folder == nullptr) return;
    const std::filesystem::path path(folder);
    writeImage(path / (name + "-embree.png"), reference);
    writeImage(path / (name + "-accumulation.png"), image);
    writeImage(path / (name + "-difference.png"), differenceImage(reference, image, 16));
}

// Expects the difference between rasterizer and ray tracer at equal lens points to have no structure: the images are
// neither shifted nor scaled against each other, and their blur has the same width. The bounds are far below the noise
// of 256 samples with different lens points.
void expectNoStructure(const std::string& name, const TruthScene& baked, const Image& image,
                       const RenderSettings& settings) {
    const Image planned = traced(baked.world, baked.view, settings, EmbreeSampling::planned);
    View widerLens = baked.view;
    widerLens.lens.fStop /= 1.05;
    const Image wider = traced(baked.world, widerLens, settings, EmbreeSampling::planned);

    writeForPeople(name + "-planned", planned, image);
    const BlockDifference blocks = blockDifference(planned, image);
    const double widened = 0.05 * shareOfChange(planned, image, planned, wider);
    const Misplacement moved = misplacement(planned, image);
    EXPECT_GE(compareImages(planned, image).psnr, 70) << name;
    EXPECT_LE(blocks.largest, 1.5e-4) << name;
    EXPECT_LE(std::abs(blocks.mean), 2e-6) << name;
    EXPECT_NEAR(widened, 0, 5e-4) << name;      // ratio of the blur's width to the ray tracer's, minus 1
    EXPECT_NEAR(moved.right, 0, 1e-3) << name;  // shift, px
    EXPECT_NEAR(moved.down, 0, 1e-3) << name;
    EXPECT_NEAR(moved.growth * baked.view.width, 0, 2e-3) << name;  // change in the image's size, px
}

void expectTruth(const std::string& name, Scene scene) {
    const std::unique_ptr<GlContext> context = createHeadlessContext();
    const std::unique_ptr<TruthScene> baked = truthScene(std::move(scene), 512, 384);
    const RenderSettings settings = fullDetailSettings(256);
    const Image image = rasterised(baked->world, baked->view, settings);
    const Image reference = traced(baked->world, baked->view, settings);
    writeForPeople(name, reference, image);

    const Difference difference = compareImages(reference, image);
    EXPECT_GE(difference.psnr, 45) << name;
    EXPECT_EQ(difference.nonFinite, 0) << name;
    // At 256 samples, the bounds allow for the noise of the ray tracer's independent sample points. They also allow for
    // the mean of the rasterizer's lens points, which is up to 0.006 lens radii off the lens's centre.
    const BlockDifference blocks = blockDifference(reference, image);
    EXPECT_LE(blocks.largest, 5e-4) << name;  // an eighth of a step of an 8-bit value
    EXPECT_LE(std::abs(blocks.mean), 1e-4) << name;
    expectNoStructure(name, *baked, image, settings);
}

TEST(Truth, FishSchoolEqualsTheRayTracer) {
    SKIP_ON_SECOND_DRIVER();
    expectTruth("fish", fishSchool({.trianglesPerFish = 15'000}));
}

TEST(Truth, FlightHelmetEqualsTheRayTracer) {
    SKIP_ON_SECOND_DRIVER();
    DEFOCUS_MODEL_OR_SKIP(path, "FlightHelmet/FlightHelmet.gltf");
    expectTruth("FlightHelmet", loadGltf(path));
}

TEST(Truth, SkullEqualsTheRayTracer) {
    SKIP_ON_SECOND_DRIVER();
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
    SKIP_ON_SECOND_DRIVER();
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
    SKIP_ON_SECOND_DRIVER();
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
}  // namespace defocus::engine
