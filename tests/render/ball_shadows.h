#pragma once
// Fixture that compares soft shadows on the GPU with the ray tracer: a matt ball in front of a wall, under one light
// and through a wide lens.

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>

#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "likeness.h"
#include "render/accumulation/accumulation.h"
#include "render/rendered.h"
#include "small_world.h"

namespace defocus::engine {

class TruthOfShadows : public testing::Test {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }

    static std::unique_ptr<SmallWorld> ballBeforeAWall() {
        auto small = std::make_unique<SmallWorld>();
        const Material matt{.metallicFactor = 0, .specularFactor = 0};
        small->scene.materials.push_back(matt);
        small->scene.meshes.push_back(quad(0));
        small->scene.meshes.push_back(bumpySphere(96, 64, 0));
        small->scene.meshes.back().vertices.colors.clear();
        place(*small, 0, glm::scale(glm::translate(glm::dmat4(1), {0, 0, -5}), glm::dvec3(4)));
        place(*small, 1, glm::scale(glm::translate(glm::dmat4(1), {0.5, 0.2, -3.5}), glm::dvec3(0.5)));
        small->world.lights = {sunFrom({-0.6, -0.3, -1}, 3)};
        small->world.lights[0].light.angularDiameter = 0.15f;
        small->world.environment = {EnvironmentType::uniform, {}, {}, {}, nullptr, 1};
        small->view.width = 256;
        small->view.height = 192;
        small->view.lens.fStop = 0.4;
        small->view.lens.focusDistance = 5;
        small->world.pyramids = {fullDetail(small->scene.meshes[0]), fullDetail(small->scene.meshes[1])};
        return small;
    }

    static Image drawn(const SmallWorld& small, Renderer& renderer, Shadows shadows, std::uint32_t samples) {
        const RenderSettings settings{.sampleCount = samples, .lod = LodMode::off, .shadows = shadows};
        return imageOf(renderer, planFrame(small.world, small.view, settings));
    }

    static void expectTheSameShadows(const SmallWorld& small, std::uint32_t samples, double minPsnr) {
        const auto context = createHeadlessContext();
        const auto accumulation = makeAccumulationRenderer(small.world, {});
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
};

}  // namespace defocus::engine
