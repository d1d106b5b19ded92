#pragma once
// Fixture that compares images with and without culling of clusters (groups of triangles).

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "gl_conduct.h"
#include "gl_context_test.h"
#include "models.h"
#include "posed_world.h"
#include "render/accumulation/accumulation.h"
#include "render/aov/work.h"
#include "render/methods.h"
#include "small_world.h"

namespace defocus::engine {

class Visibility : public GlContextTest {
protected:
    void SetUp() override { SKIP_ON_SECOND_DRIVER(); }

    static RenderSettings settingsFor(LodMode lod, bool keepAll) {
        return {.sampleCount = 24, .lod = lod, .thresholds = {0.5, 2}, .keepAll = keepAll};
    }

    static Image rendered(const SmallWorld& small, const FramePlan& plan, std::uint32_t wave) {
        const RendererOptions options{.wave = wave};
        const auto renderer = makeAccumulationRenderer(small.world, options);
        drawAllSamples(*renderer, plan);
        EXPECT_EQ(renderer->stats().trianglesDrawn, plan.trianglesDrawn);
        return renderer->image();
    }

    // Returns the plan without culling of clusters, so that all triangles of the chosen levels of detail are drawn.
    static FramePlan drawnWhole(const SmallWorld& small, FramePlan plan) {
        plan.trianglesDrawn += plan.trianglesFacingAway + plan.trianglesOutside;
        for (ObjectPlan& object : plan.objects) {
            object.visible.clear();
            for (LevelDraw* draw : {&object.coarse, &object.fine})
                draw->triangleCount =
                    small.world.pyramids[static_cast<std::size_t>(object.mesh)].levels[draw->level].triangleCount;
        }
        return plan;
    }

    // Expects the same image with and without culling of clusters. Returns the culled fraction of the triangles.
    static double expectSameImage(const SmallWorld& small, LodMode lod) {
        const FramePlan seen = planFrame(small.world, small.view, settingsFor(lod, false));
        const FramePlan all = drawnWhole(small, seen);
        EXPECT_TRUE(rendered(small, all, 0).pixels == rendered(small, seen, 5).pixels);
        EXPECT_TRUE(renderWork(small.world, all).pixels == renderWork(small.world, seen).pixels);
        return static_cast<double>(seen.trianglesFacingAway + seen.trianglesOutside) /
               static_cast<double>(all.trianglesDrawn);
    }

    static double expectSameImages(const std::filesystem::path& path) {
        const auto small = posedWorld(path, 0, 0);
        small->view.lens.fStop = 0.5;
        return std::max(expectSameImage(*small, LodMode::off), expectSameImage(*small, LodMode::fractional));
    }
};

// Parameterized fixture for scanned and hand-made models, with needle-shaped triangles, folds and holes.
class VisibilityOf : public Visibility, public testing::WithParamInterface<const char*> {};

}  // namespace defocus::engine
