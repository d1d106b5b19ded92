// Implements the functions of the public API that need no renderer object.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/error.h"
#include "core/message.h"
#include "core/number_text.h"
#include "defocus/renderer.h"
#include "defocus/scene.h"
#include "frame/report/plan_report.h"
#include "frame/settings/settings.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/scene_scale.h"
#include "frame/setup/shared_scene.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/cache.h"
#include "lod/pyramid/finish.h"
#include "scene/gltf/gltf.h"
#include "scene/scene_from_data.h"

namespace defocus {

namespace {

template <typename Things>
std::vector<std::string> namesOf(const Things& things) {
    std::vector<std::string> names;
    for (const auto& thing : things) names.push_back(thing.name);
    return names;
}

// Sets the lens of a camera and converts distances from metres to scene units. Throws UsageError, whose message begins
// with `label`, for settings that a camera cannot store.
void addLens(const std::string& label, const LensSettings& settings, double metresPerUnit, engine::Camera& camera) {
    if (!settings.apertureImage.empty())
        throw UsageError(engine::shortLine(label) +
                         ": a camera in SceneData does not support apertureImage; set it in Request::lens");
    engine::Lens scratch;
    for (auto [name, value] : engine::givenLensValues(settings)) {
        const engine::LensField& field = *engine::lensFieldNamed(name);
        try {
            engine::setLensField(scratch, field, value);
        } catch (const Error& error) {
            throw UsageError(engine::shortLine(fmt::format("{}: {}", label, error.what())));
        }
        camera.lens[name] = std::string_view(field.unit) == "M" ? value / metresPerUnit : value;
    }
}

glm::dvec3 finiteVector(const char* name, const Vector3& vector) {
    for (const double coordinate : vector)
        if (!std::isfinite(coordinate))
            throw UsageError(fmt::format("lookAt: {} is not finite (NaN or infinite)", name));
    return {vector[0], vector[1], vector[2]};
}

}  // namespace

Matrix4 lookAt(const Vector3& position, const Vector3& target, const Vector3& up) {
    const glm::dvec3 from = finiteVector("position", position);
    const glm::dvec3 back = from - finiteVector("target", target);
    const glm::dvec3 upwards = finiteVector("up", up);
    const glm::dvec3 aside = glm::cross(upwards, back);
    if (!(glm::length(back) > 0)) throw UsageError("lookAt: position and target are equal");
    if (!(glm::length(aside) > 1e-9 * glm::length(upwards) * glm::length(back)))
        throw UsageError("lookAt: up is parallel to the line of sight; give another direction");
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 x = glm::normalize(aside);
    const glm::dvec3 y = glm::cross(z, x);
    return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, from.x, from.y, from.z, 1};
}

Scene Scene::load(const std::filesystem::path& path, const Progress& progress, const std::string& variant) {
    if (path.empty()) throw UsageError("no scene given; give the path of a .gltf or .glb file");
    const auto scene = std::make_shared<engine::Scene>(engine::loadGltf(path, progress, variant));
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

Scene Scene::create(const SceneData& data) {
    const auto scene = std::make_shared<engine::Scene>(engine::sceneFromData(data));
    for (std::size_t i = 0; i < data.cameras.size(); ++i)
        addLens(engine::partLabel("camera", i, data.cameras[i].name), data.cameras[i].lens, data.metresPerUnit,
                scene->cameras[i]);
    engine::setScale({}, *scene);
    return Scene(scene);
}

SceneInfo Scene::info() const {
    const engine::Scene& scene = *scene_;
    SceneInfo info;
    info.name = scene.name;
    info.cameras = namesOf(scene.cameras);
    info.nodes = namesOf(scene.nodes);
    info.clips = namesOf(scene.clips);
    info.variants = scene.variants;
    for (const engine::Mesh& mesh : scene.meshes) info.triangles += mesh.triangleCount();
    info.ignored = engine::ignoredLines(scene);
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
    options.memoryLimit = request.memory.value_or(0);
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
