// Soft shadows on the GPU against the ray tracer's shadow rays: a matt ball before a wall, under one light and through
// a wide lens.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "image/metrics.h"
#include "render/methods.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

std::unique_ptr<SmallWorld> ballBeforeAWall() {
    auto small = std::make_unique<SmallWorld>();
    Material matt;
    matt.metallicFactor = 0;
    matt.specularFactor = 0;
    small->scene.materials.push_back(matt);
    small->scene.meshes.push_back(quad(0));
    small->scene.meshes.push_back(bumpySphere(96, 64, 0));
    small->scene.meshes.back().vertices.colors.clear();
    place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -5}), glm::dvec3(4)));
    place(*small, 1, glm::scale(glm::translate(glm::dmat4(1), {0.5, 0.2, -3.5}), glm::dvec3(0.5)));
    PlacedLight sun;
    sun.light.intensity = 3;
    sun.light.angularDiameter = 0.15f;
    sun.direction = glm::normalize(glm::dvec3(-0.6, -0.3, -1));
    small->world.lights.push_back(sun);
    small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
    small->view.width = 256;
    small->view.height = 192;
    small->view.lens.fStop = 0.4;
    small->view.lens.focusDistance = 5;
    small->world.pyramids = {fullDetail(small->scene.meshes[0]), fullDetail(small->scene.meshes[1])};
    return small;
}

Image drawn(const SmallWorld& small, Renderer& renderer, Shadows shadows, std::uint32_t samples) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = LodMode::off;
    settings.shadows = shadows;
    renderer.start(planFrame(small.world, small.view, settings));
    while (renderer.advance()) {
    }
    return renderer.image();
}

double meanRed(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y)[0]);
    return sum / (static_cast<double>(image.width) * image.height);
}

void expectTheSameShadows(const SmallWorld& small, std::uint32_t samples, double minPsnr) {
    const auto context = createHeadlessContext();
    const auto accumulation = methodNamed("accumulation").make(small.world, {});
    const auto tracer = makeEmbreeRenderer(small.world, EmbreeSampling::planned);
    const Image open = drawn(small, *tracer, Shadows::off, samples);
    const Image traced = drawn(small, *tracer, Shadows::on, samples);
    const Image raster = drawn(small, *accumulation, Shadows::on, samples);
    EXPECT_LT(meanRed(traced), 0.97 * meanRed(open)) << "there is a shadow";
    EXPECT_NEAR(meanRed(raster), meanRed(traced), 0.01 * meanRed(traced));
    const double psnr = compareImages(traced, raster).psnr;
    testing::Test::RecordProperty("psnr", std::to_string(psnr));
    EXPECT_GT(psnr, minPsnr) << psnr;
}

// With the same points on lens and sun, the images differ only by shadow-map texels. Maps round a shadow's edge to
// different texels in each sample. They also lift lookups by part of a texel, which shows where light grazes the ball.
TEST(TruthOfShadows, rasteriserAndRayTracerSeeTheSamePenumbrae) {
    expectTheSameShadows(*ballBeforeAWall(), 64, 37);
}

// The ray tracer's lamp disks face each lit point, the rasterizer's face the middle of the scene. Their points differ,
// but their means are alike. The map of a lamp without a cone has wider texels.
TEST(TruthOfShadows, lampsThrowTheSamePenumbrae) {
    for (const LightType type : {LightType::point, LightType::spot}) {
        const auto small = ballBeforeAWall();
        PlacedLight lamp;
        lamp.light.type = type;
        lamp.light.intensity = 20;
        lamp.light.radius = 0.15f;
        lamp.light.innerConeAngle = 0.5f;
        lamp.light.outerConeAngle = 0.7f;
        lamp.position = {2, 1, -1.5};
        lamp.direction = glm::normalize(glm::dvec3(0, 0, -4.5) - lamp.position);
        small->world.lights = {lamp};
        expectTheSameShadows(*small, 256, type == LightType::spot ? 35 : 29.5);
    }
}

}  // namespace
}  // namespace defocus::engine
