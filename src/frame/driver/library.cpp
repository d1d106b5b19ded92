// Functions of the public API that need no renderer of their own.

#include <fmt/format.h>

#include "core/error.h"
#include "core/number_text.h"
#include "defocus/renderer.h"
#include "defocus/scene.h"
#include "frame/report/plan_report.h"
#include "frame/settings/settings.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/scene_scale.h"
#include "lod/pyramid/cache.h"
#include "lod/pyramid/finish.h"
#include "scene/gltf/gltf.h"

namespace defocus {

namespace {

template <typename Things>
std::vector<std::string> namesOf(const Things& things) {
    std::vector<std::string> names;
    for (const auto& thing : things) names.push_back(thing.name);
    return names;
}

}  // namespace

Scene Scene::load(const std::filesystem::path& path, const Progress& progress) {
    if (path.empty()) throw UsageError("no scene given; give the path of a .gltf or .glb file");
    const auto scene = std::make_shared<engine::Scene>(engine::loadGltf(path, progress));
    engine::setScale({}, *scene);
    return Scene(scene);
}

Scene Scene::schoolOfFish(int fishCount, int trianglesPerFish, const Progress& progress) {
    Request request;
    request.fishCount = fishCount;
    request.trianglesPerFish = trianglesPerFish;
    engine::checkRequest(request);
    return Scene(std::make_shared<engine::Scene>(engine::loadScene(request, progress)));
}

SceneInfo Scene::info() const {
    const engine::Scene& scene = *scene_;
    SceneInfo info;
    info.name = scene.name;
    info.cameras = namesOf(scene.cameras);
    info.nodes = namesOf(scene.nodes);
    info.clips = namesOf(scene.clips);
    for (const engine::Mesh& mesh : scene.meshes) info.triangles += mesh.triangleCount();
    for (const engine::Ignored& entry : scene.ignored)
        info.ignored.push_back(entry.count > 1
                                   ? fmt::format("{} × {}: {}", engine::grouped(entry.count), entry.what, entry.reason)
                                   : fmt::format("{}: {}", entry.what, entry.reason));
    return info;
}

Image render(const Request& request, const Progress& progress) {
    return SceneRenderer(request, progress).render(progress);
}

Plan plan(const Request& request, const Progress& progress) {
    engine::checkRequest(request);
    const engine::PreparedFrame frame = engine::prepareFrame(request, progress);
    return engine::reportedPlan(engine::planFrame(frame.world, frame.view, frame.settings));
}

std::vector<Pyramid> pyramids(const Request& request, const Progress& progress) {
    engine::checkRequest(request);
    const engine::Scene scene = engine::loadScene(request, progress);
    engine::PyramidOptions options;
    options.vertices = request.levelVertices;
    const engine::Finishes finishes(scene);
    options.finishes = &finishes;
    const std::vector<engine::Pyramid> built =
        engine::cachedPyramids(scene.meshes, engine::pyramidFolder(request), options, progress).pyramids;
    std::vector<Pyramid> reported;
    for (std::size_t i = 0; i < built.size(); ++i)
        reported.push_back(engine::reportedPyramid(built[i], scene.meshes[i].name, i));
    return reported;
}

void setSetting(Request& request, const std::string& name, const std::string& text) {
    engine::setByName(request, name, text);
}

}  // namespace defocus
