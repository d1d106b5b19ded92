#include "eval/prediction/prediction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <memory>

#include "core/error.h"
#include "lod/pyramid/blurred_error.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/picture.h"
#include "plan/lens_cells/blurred_patches.h"
#include "render/accumulation/accumulation.h"
#include "scene/defaults.h"

namespace defocus::engine {

namespace {

constexpr std::uint32_t fewSamples = 64;
// Number of lens samples per image. More are not needed, because the noise of the samples averages out of the errors;
// see renderedError().
constexpr std::uint32_t enoughSamples = 1024;

// Scene for the measurement: a single static mesh without background, under the default lights, with the focal plane
// far away.
struct Stand {
    World world;
    View view;
    PlacedCamera camera;
    double depth = 0;  // depth of the mesh's centre, m
};

// Rotates the mesh so that the camera sees it from the direction `towards`, one of the directions from which the
// pyramid's errors were predicted.
void turnTo(Stand& stand, const glm::dvec3& towards) {
    const Pyramid& pyramid = stand.world.pyramids[0];
    const Eye eye = eyeAlong(pyramid, towards, 1);
    const glm::dmat3 turn =
        glm::dmat3(stand.camera.worldFromCamera) * glm::transpose(glm::dmat3(eye.right, eye.up, eye.towards));
    const glm::dvec3 centre = pyramid.bounds.centre();
    glm::dmat4 worldFromObject(turn);
    worldFromObject[3] = glm::dvec4(centre - turn * centre, 1);
    for (Object& object : stand.world.pose.objects) object.worldFromObject = worldFromObject;
}

Stand standFor(const PreparedFrame& frame, const PredictionOptions& options) {
    const auto scene = std::make_shared<Scene>(*frame.scene);
    const auto largest = std::max_element(scene->meshes.begin(), scene->meshes.end(), [](const Mesh& a, const Mesh& b) {
        return a.triangleCount() < b.triangleCount();
    });
    if (largest == scene->meshes.end()) fail("{}: the scene has no mesh", frame.sceneName);
    scene->meshes = {Mesh(*largest)};
    scene->cameras.clear();
    scene->lights.clear();
    scene->environment.reset();
    scene->skins.clear();
    scene->clips.clear();
    Node node;
    node.mesh = 0;
    scene->nodes = {node};
    scene->roots = {0};
    Stand stand;
    stand.world.scene = scene;
    stand.world.pose = poseAt(*scene, 0);
    const Finishes finishes(*scene);
    stand.world.pyramids = buildPyramids(scene->meshes, {.finishes = &finishes});
    if (stand.world.pyramids[0].levels.size() < 2) fail("{}: no mesh has levels of detail", frame.sceneName);
    // Frame the bounding sphere, so that the mesh is inside the image from all view directions.
    const Bounds& bounds = stand.world.pyramids[0].bounds;
    const glm::dvec3 radius(0.5 * glm::length(bounds.size()));
    Pose ball = stand.world.pose;
    ball.bounds = {bounds.centre() - radius, bounds.centre() + radius};
    const double aspect = static_cast<double>(options.width) / options.height;
    stand.camera = chooseCamera(*scene, ball, {}, aspect);
    stand.world.lights = lightsOrDefault(*scene, stand.world.pose, stand.camera);
    stand.world.environment = environmentOrDefault(*scene);
    stand.world.environment.visible = false;
    stand.view.width = options.width;
    stand.view.height = options.height;
    stand.view.worldFromCamera = stand.camera.worldFromCamera;
    stand.view.nearPlane = stand.camera.camera.znear;
    stand.depth = glm::distance(glm::dvec3(stand.camera.worldFromCamera[3]), bounds.centre());
    stand.view.lens.focusDistance = 1e6 * stand.depth;
    return stand;
}

// Sets the f-number that gives the mesh's centre a circle of confusion of `coc` px.
void blurBy(Stand& stand, double coc) {
    Lens& lens = stand.view.lens;
    const double aperture = coc * stand.depth * 2 * tanHalfHorizontalFov(lens) / stand.view.width;
    lens.fStop = lens.focalLength / (1000 * aperture);
}

FramePlan planOf(const Stand& stand, std::uint32_t samples, std::uint32_t level, std::uint32_t seed = 0) {
    const RenderSettings settings{.sampleCount = samples, .seed = seed, .lod = LodMode::off, .keepAll = true};
    FramePlan plan = planFrame(stand.world, stand.view, settings);
    for (ObjectPlan& object : plan.objects) {
        object.fine.level = level;
        object.fine.triangleCount = stand.world.pyramids[0].levels[level].triangleCount;
    }
    return plan;
}

using Views = std::vector<Image>;

// Renders a level from each of the prediction's view directions.
Views viewsOf(Stand& stand, std::uint32_t samples, std::uint32_t level, std::uint32_t seed,
              const RendererOptions& options) {
    Views views;
    for (const glm::dvec3& towards : blurredErrorViews()) {
        turnTo(stand, towards);
        const auto renderer = makeAccumulationRenderer(stand.world, options);
        views.push_back(imageOf(*renderer, planOf(stand, samples, level, seed)));
    }
    return views;
}

// Images from two independent sets of lens samples. The noise of the two sets is uncorrelated.
using TwoSets = std::array<Views, 2>;

TwoSets twoSetsOf(Stand& stand, std::uint32_t level, const RendererOptions& options) {
    return {viewsOf(stand, enoughSamples, level, 1, options), viewsOf(stand, enoughSamples, level, 2, options)};
}

// Mean radiance of the pixels that the mesh covers, and the covered area in pixels.
struct Light {
    double mean = 0;
    double cover = 0;
};

Light lightOf(const Views& views) {
    Light light;
    for (const Image& image : views)
        for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
            for (std::size_t c = 0; c < 3; ++c) light.mean += double{image.pixels[i + c]} / 3;
            light.cover += double{image.pixels[i + 3]};
        }
    if (light.cover > 0) light.mean /= light.cover;
    return light;
}

// Returns the RMS error over the covered area, relative to the mean radiance. Radiance is clamped at shownWhite times
// the mean. For each pixel, the differences between the level's image and the reference image from two independent sets
// of lens samples are multiplied. The noise of these differences averages out, so that the error for N → ∞ samples
// remains.
double renderedError(const TwoSets& reference, const TwoSets& level) {
    const Light light = lightOf(reference[0]);
    if (!(light.mean > 0)) return 0;
    const double white = shownWhite * light.mean;
    const auto change = [&](std::size_t set, std::size_t view, std::size_t i) {
        return std::min(double{level[set][view].pixels[i]}, white) -
               std::min(double{reference[set][view].pixels[i]}, white);
    };
    double products = 0;
    for (std::size_t view = 0; view < reference[0].size(); ++view)
        for (std::size_t i = 0; i < reference[0][view].pixels.size(); ++i)
            if (i % 4 != 3) products += change(0, view, i) * change(1, view, i) / 3;
    return std::sqrt(std::max(products, 0.0) / light.cover) / light.mean;
}

// Returns the square root of the mean of `squared` over all patch sizes `sides`.
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
        const double pixelsPerUnit = pixelsPerUnitAtCentre(plan.objects.front(), plan);
        const double finest = levelOfBlurredError(pyramid, sides, pixelsPerUnit, lightAt(512));
        const double coarsest = levelOfBlurredError(pyramid, sides, pixelsPerUnit, lightAt(16));
        const TwoSets reference = twoSetsOf(stand, 0, options.renderer);

        PredictionRow row;
        row.mesh = stand.world.scene->meshes[0].name;
        row.coc = coc;
        row.triangles = pyramid.levels[0].triangleCount;
        row.predicted = rootMean(sides, [&](double side) { return squaredContrast(pyramid, side); }) *
                        expectedSampleError(fewSamples);
        const Views few = viewsOf(stand, fewSamples, 0, 0, options.renderer);
        row.rendered = renderedError(reference, {few, few});
        row.used = true;
        visit(row);
        report(progress, "levels", ++done, total);
        for (row.level = 1; row.level < levels; ++row.level) {
            row.triangles = pyramid.levels[row.level].triangleCount;
            row.predicted = rootMean(sides, [&](double side) { return squaredError(pyramid, row.level, side); });
            row.rendered = renderedError(reference, twoSetsOf(stand, row.level, options.renderer));
            row.used = row.level < coarsest + 1 && row.level > finest - 1;
            visit(row);
            report(progress, "levels", ++done, total);
        }
    }
}

}  // namespace defocus::engine
