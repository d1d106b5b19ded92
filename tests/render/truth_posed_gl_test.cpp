// Tests objects posed on the GPU against the ray tracer, whose meshes the CPU poses. Both use the same lens points.

#include <gtest/gtest.h>

#include "baked_scene.h"
#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/metrics.h"
#include "lod/pyramid/build_all.h"
#include "models.h"
#include "posed_world.h"
#include "render/accumulation/accumulation.h"
#include "render/rendered.h"

namespace defocus::engine {
namespace {

Image rendered(const SmallWorld& small, Renderer& renderer) {
    const RenderSettings settings{.sampleCount = 32, .lod = LodMode::off};
    return imageOf(renderer, planFrame(small.world, small.view, settings));
}

class PosedTruth : public testing::TestWithParam<PosedModel> {};

TEST_P(PosedTruth, rasteriserAndRayTracerSeeTheSamePose) {
    SKIP_ON_SECOND_DRIVER();
    const auto& [file, clip] = GetParam();
    DEFOCUS_MODEL_OR_SKIP(path, file);
    const auto context = createHeadlessContext();
    const auto small = posedWorld(path, 0.7, clip);
    small->scene = bakedUnlit(std::move(small->scene));
    small->world.pyramids = buildPyramids(small->scene.meshes);
    small->view.lens.fStop = 0.1;
    const Image raster = rendered(*small, *makeAccumulationRenderer(small->world, {}));
    const Image traced = rendered(*small, *makeEmbreeRenderer(small->world, EmbreeSampling::planned));
    EXPECT_GT(compareImages(traced, raster).psnr, 45);
}

INSTANTIATE_TEST_SUITE_P(Models, PosedTruth, testing::ValuesIn(posedModels), posedModelName);

}  // namespace
}  // namespace defocus::engine
