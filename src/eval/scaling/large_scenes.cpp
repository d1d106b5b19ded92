#include "eval/scaling/large_scenes.h"

#include <fmt/format.h>

#include <memory>

#include "core/memory.h"
#include "core/memory_limits.h"
#include "core/stopwatch.h"
#include "eval/scaling/worlds.h"
#include "render/accumulation/accumulation.h"

namespace defocus::engine {

std::vector<LargeScene> largeScenes() {
    return {{"100 M triangles, instances", 10'000, 10'000, true}, {"10,000 different objects", 10'000, 200, false}};
}

LargeSceneRow measureLargeScene(const LargeScene& scene, const LargeSceneOptions& options, const Progress& progress) {
    giveBackFreedMemory();  // free the memory of the previous scene
    LargeSceneRow row;
    row.scene = scene;

    // Build the world and its pyramids.
    const Clock::time_point begin = Clock::now();
    const ScalingWorld world =
        scene.instances ? gridOf(scene.objects, scene.trianglesPerObject, options.cacheFolder)
                        : differentFish(scene.objects, scene.trianglesPerObject, options.cacheFolder, progress);
    row.worldMilliseconds = millisecondsSince(begin);
    row.meshes = world.scene->meshes.size();
    for (const Object& object : world.world.pose.objects)
        row.triangles += world.world.pyramids[static_cast<std::size_t>(object.mesh)].levels.front().triangleCount;

    // Time the planning repeatedly.
    const RenderSettings settings{.sampleCount = 8};
    FramePlan plan;
    std::vector<double> times;
    for (int i = 0; i <= options.runs; ++i) {
        const Clock::time_point start = Clock::now();
        plan = planFrame(world.world, world.view, settings);
        if (i > 0) times.push_back(millisecondsSince(start));
    }
    row.planMilliseconds = spreadOf(times);

    // Time the first image, which includes the creation of all resources, then a complete second frame.
    const Clock::time_point start = Clock::now();
    const std::unique_ptr<Renderer> renderer = makeAccumulationRenderer(world.world, options.renderer);
    renderer->start(plan);
    bool more = renderer->advance();
    static_cast<void>(renderer->image());
    row.firstImageMilliseconds = millisecondsSince(start);
    while (more) more = renderer->advance();
    drawAllSamples(*renderer, plan);
    const RenderStats stats = renderer->stats();
    row.frameMilliseconds = stats.renderMilliseconds;
    row.trianglesDrawn = stats.trianglesDrawn;
    row.gpuBytes = stats.peakBytes;
    row.residentBytes = residentMemory();
    return row;
}

std::string largeSceneHeader() {
    return fmt::format("\n{:<28} {:>8} {:>8} {:>10} {:>10} {:>9} {:>12} {:>9} {:>10} {:>8} {:>8}\n", "scene", "objects",
                       "meshes", "triangles", "world, s", "plan, ms", "1st image, s", "frame, s", "drawn, M", "RSS, MB",
                       "GPU, MB");
}

std::string largeSceneLine(const LargeSceneRow& row) {
    return fmt::format(
        "{:<28} {:>8} {:>8} {:>8.1f} M {:>10.1f} {:>9.1f} {:>12.2f} {:>9.2f} {:>10.2f} {:>8.0f} {:>8.0f}\n",
        row.scene.name, row.scene.objects, row.meshes, static_cast<double>(row.triangles) * 1e-6,
        row.worldMilliseconds * 1e-3, row.planMilliseconds.median, row.firstImageMilliseconds * 1e-3,
        row.frameMilliseconds * 1e-3, static_cast<double>(row.trianglesDrawn) * 1e-6,
        static_cast<double>(row.residentBytes) * 1e-6, static_cast<double>(row.gpuBytes) * 1e-6);
}

}  // namespace defocus::engine
