#include "eval/prediction/prediction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "core/error.h"
#include "lod/pyramid/blurred_error.h"
#include "plan/blurred_patches.h"
#include "scene/defaults.h"

namespace defocus {

namespace {

constexpr std::uint32_t fewSamples = 64;
constexpr std::uint32_t enoughSamples = 1024;  // so many that what is left of them is small beside a level's error

// One mesh alone before nothing, without skin or animation, focused far away.
struct Stand {
    World world;
    View view;
    double depth = 0;  // m, of the mesh's centre
};

Stand standFor(const PreparedFrame& frame, const PredictionOptions& options) {
    const auto scene = std::make_shared<Scene>(*frame.scene);
    const auto largest = std::max_element(scene->meshes.begin(), scene->meshes.end(), [](const Mesh& a, const Mesh& b) {
        return a.triangleCount() < b.triangleCount();
    });
    if (largest == scene->meshes.end()) fail("{}: the scene has no mesh", frame.sceneName);
    scene->meshes = {Mesh(*largest)};
    scene->cameras.clear();
    scene->lights.clear();
    scene->skins.clear();
    scene->clips.clear();
    Node node;
    node.mesh = 0;
    scene->nodes = {node};
    scene->roots = {0};
    Stand stand;
    stand.world.scene = scene;
    stand.world.pose = poseAt(*scene, 0);
    stand.world.pyramids = buildPyramids(scene->meshes);
    if (stand.world.pyramids[0].levels.size() < 2) fail("{}: no mesh has levels", frame.sceneName);
    const double aspect = static_cast<double>(options.width) / options.height;
    const PlacedCamera placed = chooseCamera(*scene, stand.world.pose, "", aspect);
    stand.world.lights = lightsOrDefault(*scene, stand.world.pose, placed);
    stand.world.environment = environmentOrDefault(*scene);
    stand.world.environment.visible = false;
    stand.view.width = options.width;
    stand.view.height = options.height;
    stand.view.worldFromCamera = placed.worldFromCamera;
    stand.view.nearPlane = placed.camera.znear;
    stand.depth = glm::distance(glm::dvec3(placed.worldFromCamera[3]), stand.world.pyramids[0].bounds.centre());
    stand.view.lens.focusDistance = 1e6 * stand.depth;
    return stand;
}

// The f-number that blurs the mesh's centre by `coc` px.
void blurBy(Stand& stand, double coc) {
    Lens& lens = stand.view.lens;
    const double aperture = coc * stand.depth * 2 * tanHalfHorizontalFov(lens) / stand.view.width;
    lens.fStop = lens.focalLength / (1000 * aperture);
}

FramePlan planOf(const Stand& stand, std::uint32_t samples, std::uint32_t level) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.lod = LodMode::off;
    settings.keepAll = true;
    FramePlan plan = planFrame(stand.world, stand.view, settings);
    for (ObjectPlan& object : plan.objects) {
        object.fine.level = level;
        object.fine.triangleCount = stand.world.pyramids[0].levels[level].triangleCount;
    }
    return plan;
}

Image imageOf(const Stand& stand, const FramePlan& plan, const RendererOptions& options) {
    const auto renderer = methodNamed("accumulation").make(stand.world, options);
    renderer->start(plan);
    while (renderer->advance()) {
    }
    return renderer->image();
}

// Root mean square of the difference over level 0's cover, in units of its mean light.
double renderedError(const Image& truth, const Image& image) {
    double squares = 0;
    double light = 0;
    double cover = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference = double{image.pixels[i + c]} - double{truth.pixels[i + c]};
            squares += difference * difference / 3;
            light += double{truth.pixels[i + c]} / 3;
        }
        cover += double{truth.pixels[i + 3]};
    }
    return light > 0 ? std::sqrt(squares / cover) / (light / cover) : 0;
}

// Of the squares over all patches.
template <typename Squared>
double rootMean(const std::array<double, patchDepths>& sides, const Squared& squared) {
    double sum = 0;
    for (const double side : sides) sum += squared(side);
    return std::sqrt(sum / patchDepths);
}

}  // namespace

void measurePrediction(const PreparedFrame& frame, const PredictionOptions& options,
                       const std::function<void(const PredictionRow&)>& visit, const Progress& progress) {
    Stand stand = standFor(frame, options);
    const Pyramid& pyramid = stand.world.pyramids[0];
    const auto levels = static_cast<std::uint32_t>(pyramid.levels.size());
    const std::uint64_t total = options.cocs.size() * levels;
    std::uint64_t done = 0;
    const auto lightAt = [](std::uint32_t samples) { return defaultThresholds(LodMetric::measured, samples).light; };
    for (const double coc : options.cocs) {
        blurBy(stand, coc);
        const FramePlan plan = planOf(stand, enoughSamples, 0);
        if (plan.objects.empty()) return;
        const auto sides = blurredPatches(plan.objects.front(), plan);
        const double finest = levelOfBlurredError(pyramid, sides, lightAt(512));
        const double coarsest = levelOfBlurredError(pyramid, sides, lightAt(16));
        const Image truth = imageOf(stand, plan, options.renderer);

        PredictionRow row;
        row.mesh = stand.world.scene->meshes[0].name;
        row.coc = coc;
        row.triangles = pyramid.levels[0].triangleCount;
        row.predicted = rootMean(sides, [&](double side) { return squaredContrast(pyramid, side); }) *
                        expectedSampleError(fewSamples);
        row.rendered = renderedError(truth, imageOf(stand, planOf(stand, fewSamples, 0), options.renderer));
        row.used = true;
        visit(row);
        report(progress, "levels", ++done, total);
        for (row.level = 1; row.level < levels; ++row.level) {
            row.triangles = pyramid.levels[row.level].triangleCount;
            row.predicted = rootMean(sides, [&](double side) { return squaredError(pyramid, row.level, side); });
            row.rendered =
                renderedError(truth, imageOf(stand, planOf(stand, enoughSamples, row.level), options.renderer));
            row.used = row.level < coarsest + 1 && row.level > finest - 1;
            visit(row);
            report(progress, "levels", ++done, total);
        }
    }
}

}  // namespace defocus
