// Measures the time that culling saves, at full detail and with levels of detail. Culling has two steps. Step 1 culls
// clusters (small groups of triangles) that face away or lie outside the image for all lens samples and instants of the
// exposure (plan/visible/visibility.h). Step 2 also culls triangles that are occluded in a sample
// (render/occlusion/occlusion.h).
//
//   defocus_cluster_bench [SCENE …]      without scenes: the school of fish
//
// Held constant: camera, lens, levels, samples, size (1024 x 768), renderer and process. Variants are drawn
// alternately. The table shows the fastest time of each variant, and the median ratio of the times without and with a
// culling step. `CPU` is the time of all threads, which depends less on other load. The images are compared bit by bit.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "frame/setup/prepared_frame.h"
#include "gl/context.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "run_bench.h"

namespace {

using namespace defocus;
using namespace defocus::engine;

constexpr int turns = 3;

struct Variant {
    FramePlan plan;
    std::vector<double> seconds;
    std::vector<double> cpuSeconds;
    Image image;
    std::uint64_t hidden = 0;  // triangles culled as occluded
};

void renderOnce(const World& world, Variant& variant) {
    const auto renderer = makeAccumulationRenderer(world, {});
    const std::clock_t before = std::clock();
    drawAllSamples(*renderer, variant.plan);
    variant.seconds.push_back(renderer->stats().renderMilliseconds / 1000);
    variant.cpuSeconds.push_back(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    variant.image = renderer->image();
    variant.hidden = renderer->stats().trianglesHidden;
}

double fastest(const std::vector<double>& times) {
    return *std::min_element(times.begin(), times.end());
}

double medianRatio(std::vector<double> complete, const std::vector<double>& lean) {
    for (std::size_t i = 0; i < complete.size(); ++i) complete[i] /= lean[i];
    std::nth_element(complete.begin(), complete.begin() + turns / 2, complete.end());
    return complete[turns / 2];
}

// Returns the plan without occlusion culling.
FramePlan withHidden(FramePlan plan) {
    plan.settings.keepAll = true;
    return plan;
}

// Returns the plan without cluster culling: its levels are drawn completely, including the clusters that face away or
// lie outside the image.
FramePlan drawnWhole(const World& world, FramePlan plan) {
    for (ObjectPlan& object : plan.objects) {
        object.visible.clear();
        for (LevelDraw* draw : {&object.coarse, &object.fine})
            draw->triangleCount =
                world.pyramids[static_cast<std::size_t>(object.mesh)].levels[draw->level].triangleCount;
    }
    return plan;
}

std::string differences(const Image& a, const Image& b) {
    std::size_t count = 0;
    float max = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        count += a.pixels[i] != b.pixels[i] ? 1 : 0;
        max = std::max(max, std::abs(a.pixels[i] - b.pixels[i]));
    }
    return count == 0 ? "same image" : fmt::format("{} VALUES DIFFER, by up to {:.3g}", count, max);
}

double millions(std::uint64_t count) {
    return static_cast<double>(count) / 1e6;
}

std::string timesOf(const Variant& complete, const Variant& lean) {
    return fmt::format("{:>8.2f} {:>8.2f} {:>6.2f} {:>8.2f} {:>8.2f} {:>6.2f}  {}", fastest(complete.seconds),
                       fastest(lean.seconds), medianRatio(complete.seconds, lean.seconds), fastest(complete.cpuSeconds),
                       fastest(lean.cpuSeconds), medianRatio(complete.cpuSeconds, lean.cpuSeconds),
                       differences(complete.image, lean.image));
}

void printClusters(const Variant& complete, const Variant& seen) {
    const std::uint64_t away = seen.plan.trianglesFacingAway;
    const std::uint64_t outside = seen.plan.trianglesOutside;
    std::size_t runCount = 0;
    for (const ObjectPlan& object : seen.plan.objects)
        for (const VisibleLevel& level : object.visible)
            for (const std::vector<IndexRange>& ranges : level.primitives) runCount += ranges.size();
    fmt::print("{:<20} {:>8.1f} {:>8.1f} {:>8.1f} {:>7} {}\n", lodModeName(seen.plan.settings.lod),
               millions(seen.plan.trianglesDrawn + away + outside), millions(away), millions(outside), runCount,
               timesOf(complete, seen));
}

void printHidden(const Variant& seen, const Variant& shown) {
    fmt::print("{:<20} {:>8.1f} {:>8.1f} {:>16} {}\n", fmt::format("hidden, {}", lodModeName(shown.plan.settings.lod)),
               millions(shown.plan.trianglesDrawn), millions(shown.hidden), "", timesOf(seen, shown));
}

void measure(const std::filesystem::path& path) {
    Request options;
    options.scene = path;
    const PreparedFrame frame = prepareFrame(options);
    std::vector<Variant> variants;
    for (const LodMode lod : {LodMode::off, LodMode::fractional}) {
        RenderSettings settings = frame.settings;
        settings.lod = lod;
        const FramePlan plan = planFrame(frame.world, frame.view, settings);
        for (FramePlan& drawn : std::array{withHidden(drawnWhole(frame.world, plan)), withHidden(plan), plan})
            variants.push_back({std::move(drawn), {}, {}, {}});
    }
    for (int turn = 0; turn < turns; ++turn)
        for (std::size_t i = 0; i < variants.size(); ++i)  // rotate the order, so that no variant is always first
            renderOnce(frame.world, variants[(i + static_cast<std::size_t>(turn)) % variants.size()]);
    fmt::print("\n{}\n", frame.sceneName);
    for (std::size_t i = 0; i < variants.size(); i += 3) {
        printClusters(variants[i], variants[i + 1]);
        printHidden(variants[i + 1], variants[i + 2]);
    }
}

int run(const std::vector<std::filesystem::path>& scenes) {
    const auto context = createHeadlessContext();
    fmt::print(
        "{}, {}\n1024 x 768, 64 samples, {} turns; whole | clusters left out, and of what "
        "is drawn then | what is hidden\n\n",
        context->device(), context->driver(), turns);
    fmt::print("{:<20} {:>8} {:>8} {:>8} {:>7} {:>17} {:>6} {:>17} {:>6}\n", "levels", "M tri", "left out", "outside",
               "runs", "frame, s", "ratio", "CPU, s", "ratio");
    for (const std::filesystem::path& scene : scenes) measure(scene);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return defocus::engine::runBench("defocus_cluster_bench", [&] {
        std::vector<std::filesystem::path> scenes(argv + 1, argv + argc);
        if (scenes.empty()) scenes.emplace_back();
        return run(scenes);
    });
}
