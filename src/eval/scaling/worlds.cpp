#include "eval/scaling/worlds.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "lod/pyramid/cache.h"

namespace defocus::engine {

namespace {

constexpr int fishCount = 8;
constexpr double gridNear = 2;     // depth of the grid's front, m
constexpr double gridFar = 6;      // depth of the grid's back, m
constexpr double gridWidth = 0.8;  // width of the grid, as a fraction of the view's width

// Sets pose, camera, lens, lights and environment of the built-in school of fish. The caller adds the pyramids.
void surround(ScalingWorld& result) {
    const Scene& scene = *result.scene;
    World& world = result.world;
    world.scene = result.scene;
    world.pose = poseAt(scene, 0);
    const double aspect = 4.0 / 3.0;
    const PlacedCamera placed = chooseCamera(scene, world.pose, {}, aspect);
    View& view = result.view;
    view.width = 640;
    view.height = 480;
    view.worldFromCamera = placed.worldFromCamera;
    view.nearPlane = placed.camera.znear;
    view.lens.focalLength = focalLengthFromFov(aspect * std::tan(placed.camera.yfov / 2), view.lens.horizontalAperture);
    view.lens.fStop = placed.camera.lensValue("fStop").value_or(view.lens.fStop);
    view.lens.focusDistance = placed.camera.lensValue("focusDistance").value_or(view.lens.focusDistance);
    world.lights = lightsOrDefault(scene, world.pose, placed);
    world.environment = environmentOrDefault(scene);
}

}  // namespace

ScalingWorld schoolOf(std::uint64_t triangles, const std::filesystem::path& cacheFolder, const Progress& progress) {
    return differentFish(fishCount, static_cast<int>(triangles / fishCount), cacheFolder, progress);
}

ScalingWorld differentFish(int count, int triangles, const std::filesystem::path& cacheFolder,
                           const Progress& progress) {
    ScalingWorld result;
    Request request;
    request.fishCount = count;
    request.trianglesPerFish = triangles;
    *result.scene = loadScene(request, progress);
    surround(result);
    result.world.pyramids = cachedPyramids(result.scene->meshes, cacheFolder, {}, progress).pyramids;
    return result;
}

ScalingWorld gridOf(int instances, int triangles, const std::filesystem::path& cacheFolder) {
    ScalingWorld result;
    Request request;
    request.fishCount = 1;
    request.trianglesPerFish = triangles;
    *result.scene = loadScene(request);
    surround(result);
    result.world.pyramids = cachedPyramids(result.scene->meshes, cacheFolder).pyramids;

    // Divide the view frustum into cells, from front to back, and place a fish at the centre of each.
    const int side = std::max(1, static_cast<int>(std::ceil(std::cbrt(instances) - 1e-9)));
    const Bounds& box = result.world.pyramids.front().bounds;
    const double extent = std::max({box.size().x, box.size().y, box.size().z});
    const double halfWidth = gridWidth * tanHalfHorizontalFov(result.view.lens);
    const double halfHeight = halfWidth * result.view.height / result.view.width;
    const auto middle = [side](int cell) { return (cell + 0.5) / side; };
    Pose& pose = result.world.pose;
    pose.objects.clear();
    pose.bounds = {};
    for (int i = 0; i < instances; ++i) {
        const double depth = gridNear + (gridFar - gridNear) * middle(i / (side * side));
        const glm::dvec3 place(depth * halfWidth * (2 * middle(i % side) - 1),
                               depth * halfHeight * (2 * middle(i / side % side) - 1), -depth);
        const double size = 2 * depth * halfHeight / side / extent;
        Object object;
        object.mesh = 0;
        object.name = fmt::format("Fish #{}", i);
        object.worldFromObject = result.view.worldFromCamera *
                                 glm::scale(glm::translate(glm::dmat4(1), place), glm::dvec3(size)) *
                                 glm::translate(glm::dmat4(1), -box.centre());
        pose.bounds.extend(transformed(box, object.worldFromObject));
        pose.objects.push_back(std::move(object));
    }
    return result;
}

}  // namespace defocus::engine
