// Measures parts of the CPU work of a frame separately (micro-benchmarks). Held constant: one thread, the same inputs
// in every run (a mesh, pyramid, world or image pair), default lens and settings. GPU and disk are not used. Each
// benchmark checks its result and reports an error instead of a time if the result is wrong.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "image/metrics.h"
#include "lens/lens_samples.h"
#include "lod/pyramid/level_selection.h"
#include "plan/frame_plan.h"
#include "school/fish_school.h"

namespace defocus::engine {
namespace {

Scene smallSchool(int fish) {
    FishSchoolOptions options;
    options.fishCount = fish;
    options.trianglesPerFish = 5000;
    return fishSchool(options);
}

void lensSamplePoint(benchmark::State& state) {
    Lens lens;
    lens.bladeCount = static_cast<int>(state.range(0));
    const Aperture aperture = makeAperture(lens);
    const auto sequence = static_cast<Sequence>(state.range(1));
    std::uint64_t index = 0;
    glm::dvec2 sum(0);
    for (auto _ : state) sum += glm::dvec2(lensSample(aperture, sequence, index++, 1).lens);
    // The mean of all lens points must be near the lens centre.
    if (index > 1000 && glm::length(sum) / static_cast<double>(index) > 0.05) state.SkipWithError("samples off centre");
}
BENCHMARK(lensSamplePoint)->ArgNames({"blades", "sequence"})->ArgsProduct({{0, 6}, {0, 1, 2, 3}});

// Measures the selection of an object's level of detail for blurs from 0 to 40 px.
void levelOfDetailOfObject(benchmark::State& state) {
    const Pyramid pyramid = buildPyramid(smallSchool(1).meshes.front());
    const LodMetric metric = state.range(0) == 0 ? LodMetric::size : LodMetric::error;
    const LodThresholds thresholds = defaultThresholds(metric, 64);
    const double sharp = levelOfDetail(pyramid, {500, 0}, metric, thresholds);
    const double blurred = levelOfDetail(pyramid, {500, 40}, metric, thresholds);
    double coc = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(levelOfDetail(pyramid, {500, coc}, metric, thresholds));
        coc = coc < 40 ? coc + 0.1 : 0;
    }
    const double last = static_cast<double>(pyramid.levels.size()) - 1;
    if (!(sharp >= 0 && blurred > sharp && blurred <= last)) state.SkipWithError("more blur gave no coarser level");
}
BENCHMARK(levelOfDetailOfObject)->ArgName("error")->Arg(0)->Arg(1);

// Measures planning a frame with 64 samples at 1024×768 px, with levels from pyramids.
void planOfFrame(benchmark::State& state) {
    World world;
    world.scene = std::make_shared<const Scene>(smallSchool(static_cast<int>(state.range(0))));
    const Scene& scene = *world.scene;
    world.pose = poseAt(scene, 0, -1);
    world.environment = environmentOrDefault(scene);
    world.pyramids = buildPyramids(scene.meshes);
    View view;
    const PlacedCamera placed = chooseCamera(scene, world.pose, {}, static_cast<double>(view.width) / view.height);
    view.worldFromCamera = placed.worldFromCamera;
    view.lens.focusDistance = placed.camera.lensValue("focusDistance").value_or(2.5);
    RenderSettings settings;
    FramePlan plan;
    for (auto _ : state) {
        plan = planFrame(world, view, settings);
        benchmark::DoNotOptimize(plan.objects.data());
    }
    const bool everySampleOnce = std::all_of(plan.objects.begin(), plan.objects.end(), [&](const ObjectPlan& object) {
        return object.coarse.sampleCount + object.fine.sampleCount == plan.samples.size();
    });
    if (plan.objects.empty() || !everySampleOnce) state.SkipWithError("an object misses lens samples");
}
BENCHMARK(planOfFrame)->ArgName("fish")->Arg(20)->Arg(200)->Unit(benchmark::kMicrosecond);

void pyramidOfFish(benchmark::State& state) {
    const Mesh mesh = smallSchool(1).meshes.front();
    Pyramid pyramid;
    for (auto _ : state) pyramid = buildPyramid(mesh);
    for (std::size_t level = 1; level < pyramid.levels.size(); ++level) {
        if (pyramid.levels[level].triangleCount >= pyramid.levels[level - 1].triangleCount ||
            pyramid.levels[level].error <= pyramid.levels[level - 1].error) {
            state.SkipWithError("levels don't get coarser");
        }
    }
    if (pyramid.levels.size() < 2) state.SkipWithError("no coarser level");
    state.counters["triangles/s"] =
        benchmark::Counter(static_cast<double>(mesh.triangleCount()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(pyramidOfFish)->Unit(benchmark::kMillisecond);

// Measures all image metrics, on two 256×256 images whose display-encoded grey differs by 0.1 on half of the pixels.
void differenceOfImages(benchmark::State& state) {
    constexpr int size = 256;
    Image reference(size, size, 3);
    std::fill(reference.pixels.begin(), reference.pixels.end(), 0.2140411f);  // 0.5 after display encoding
    Image test = reference;
    std::fill(test.pixels.begin(), test.pixels.begin() + static_cast<std::ptrdiff_t>(test.pixels.size() / 2),
              0.3185468f);  // 0.6 after display encoding
    Difference difference;
    for (auto _ : state) difference = compareImages(reference, test);
    if (std::abs(difference.mae - 0.05) > 1e-5 || std::abs(difference.psnr - 10 * std::log10(200.0)) > 1e-3) {
        state.SkipWithError("wrong error of a known difference");
    }
}
BENCHMARK(differenceOfImages)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace defocus::engine

BENCHMARK_MAIN();
