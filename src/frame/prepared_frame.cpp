#include "frame/prepared_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>

#include "core/error.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "frame/focus.h"
#include "frame/moment.h"
#include "image/image_io.h"
#include "lens/aperture.h"
#include "lens/camera_lens.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/cache.h"
#include "scene/gltf/gltf.h"
#include "school/fish_school.h"

namespace defocus {

namespace {

Scene loadScene(const SceneOptions& options, const Progress& progress) {
    if (!options.path.empty()) return loadGltf(options.path, progress);
    FishSchoolOptions school;
    school.fishCount = options.fishCount;
    school.trianglesPerFish = options.trianglesPerFish;
    return fishSchool(school, progress);
}

// ---- surroundings
// ----------------------------------------------------------------------------------------------------

std::shared_ptr<const Image> loadEnvironment(const std::filesystem::path& path) {
    auto map = std::make_shared<Image>(readImage(path));
    for (const float value : map->pixels)
        if (std::isinf(value)) fail("{}: holds infinity and cannot light a scene", path.string());
    return map;
}

// ---- camera and lens
// -------------------------------------------------------------------------------------------------

// Everything but the focus distance, which needs the view. Values of the camera that no lens can have go to `refused`.
Lens chosenLens(const SceneOptions& options, const Camera& camera, std::vector<std::string>& refused) {
    Lens lens;
    refused = setLensFields(lens, camera.lens);
    setLensFields(lens, options.lens);
    fitToCamera(lens, camera, static_cast<double>(options.width) / options.height,
                [&](std::string_view name) { return options.lens.contains(name) || camera.lens.contains(name); });
    if (!options.apertureImage.empty()) {
        lens.apertureImage = loadApertureImage(options.apertureImage);
    } else if (!camera.apertureImage.empty()) {
        try {
            lens.apertureImage = loadApertureImage(options.path.parent_path() / camera.apertureImage);
        } catch (const Error& error) {
            refused.emplace_back(error.what());
        }
    }
    return lens;
}

// Levels of full detail are not worth storing.
std::filesystem::path chosenCacheFolder(const SceneOptions& options) {
    if (options.noCache || options.lod == LodMode::off) return {};
    return options.cacheFolder.empty() ? defaultCacheFolder() : options.cacheFolder;
}

std::vector<Pyramid> fullDetailPyramids(const std::vector<Mesh>& meshes, const Progress& progress) {
    std::vector<Pyramid> pyramids(meshes.size());
    std::mutex reporting;
    std::uint64_t done = 0;
    parallelFor(meshes.size(), [&](std::size_t i) {
        pyramids[i] = fullDetail(meshes[i]);
        const std::lock_guard lock(reporting);
        report(progress, "meshes", ++done, meshes.size());
    });
    return pyramids;
}

// The camera turned and moved as the options say.
glm::dmat4 wanderedCamera(const SceneOptions& options, const glm::dmat4& worldFromCamera) {
    const glm::dvec3 position = options.cameraPosition.value_or(glm::dvec3(worldFromCamera[3]));
    const glm::dvec3 back = options.cameraTarget ? position - *options.cameraTarget : glm::dvec3(worldFromCamera[2]);
    const glm::dvec3 up =
        options.cameraUp.value_or(options.cameraTarget ? glm::dvec3(0, 1, 0) : glm::dvec3(worldFromCamera[1]));
    const glm::dvec3 aside = glm::cross(up, back);
    if (!(glm::length(back) > 0)) fail("--camera-target: the camera stands on it; move one of them");
    if (!(glm::length(aside) > 1e-9 * glm::length(up) * glm::length(back)))
        fail("--camera-up: the camera looks along it; give another direction");
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 x = glm::normalize(aside);
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

// The camera and its lens; the focus last, as it may depend on all else.
PlacedCamera place(PreparedFrame& frame, const SceneOptions& options) {
    const double aspect = static_cast<double>(options.width) / options.height;
    PlacedCamera placed = chooseCamera(*frame.scene, frame.world.pose, options.camera, aspect);
    frame.cameraName = placed.camera.name;
    frame.view.worldFromCamera = placed.worldFromCamera;
    frame.view.nearPlane = placed.camera.znear;
    if (options.cameraPosition || options.cameraTarget || options.cameraUp) {
        frame.view.worldFromCamera = wanderedCamera(options, placed.worldFromCamera);
        frame.view.nearPlane = wanderingNearPlane(placed.camera.znear, frame.world.pose.bounds);
    }
    frame.view.width = options.width;
    frame.view.height = options.height;
    SceneOptions withoutLens = options;
    withoutLens.lens.clear();
    withoutLens.apertureImage.clear();
    frame.cameraLens = chosenLens(withoutLens, placed.camera, frame.refusedLensValues);
    frame.view.lens = chosenLens(options, placed.camera, frame.refusedLensValues);
    chooseFocus(options, placed.camera, *frame.scene, frame.world.pose, frame.view);
    checkLens(frame.view.lens);
    if (options.lens.contains("iso") && frame.view.lens.exposureTime == 0)
        frame.refusedLensValues.emplace_back("iso says nothing without an exposure time (--exposure-time)");
    return placed;
}

}  // namespace

std::shared_ptr<const Image> loadApertureImage(const std::filesystem::path& path) {
    Lens lens;
    lens.apertureImage = std::make_shared<Image>(readImage(path));
    try {
        static_cast<void>(makeAperture(lens));  // finds fault with what it holds
    } catch (const Error& error) {
        fail("{}: {}", path.string(), error.what());
    }
    return lens.apertureImage;
}

Environment chosenEnvironment(const SceneOptions& options, const Scene& scene) {
    Environment environment = environmentOrDefault(scene);
    if (!options.environment.empty()) {
        environment = {};
        environment.type = EnvironmentType::map;
        environment.map = loadEnvironment(options.environment);
    }
    if (options.background == Background::none) environment.visible = false;
    if (options.background == Background::uniform) {
        environment = {};
        environment.type = EnvironmentType::uniform;
        environment.zenith = environment.horizon = environment.nadir = options.backgroundColor;
    }
    return environment;
}

RenderSettings chosenSettings(const SceneOptions& options) {
    RenderSettings settings;
    settings.sampleCount = options.samples;
    settings.sequence = options.sequence;
    settings.seed = options.seed;
    settings.lod = options.lod;
    settings.metric = options.metric;
    settings.lodCocAtCentre = options.lodCocAtCentre;
    settings.thresholds = defaultThresholds(options.metric, options.samples);
    settings.thresholds.blur = options.blurThreshold.value_or(settings.thresholds.blur);
    settings.thresholds.size = options.sizeThreshold.value_or(settings.thresholds.size);
    settings.keepAll = options.keepAll;
    settings.cocTolerance = options.cocTolerance;
    return settings;
}

double wanderingNearPlane(double cameraNear, const Bounds& sceneBounds) {
    const double radius = 0.5 * glm::length(sceneBounds.size());
    return radius > 0 ? std::min(cameraNear, 1e-3 * radius) : cameraNear;
}

void placeCamera(PreparedFrame& frame, const SceneOptions& options) {
    place(frame, options);
}

PreparedFrame placeFrame(const SceneOptions& options, const Progress& progress) {
    // The scene, at its time.
    const Clock::time_point begin = Clock::now();
    PreparedFrame frame;
    frame.scene = std::make_shared<Scene>(loadScene(options, progress));
    frame.sceneName = options.path.empty() ? "fish school" : options.path.filename().string();
    for (const auto& [name, scale] : options.nodeBlur)
        frame.scene->nodes[static_cast<std::size_t>(nodeNamed(*frame.scene, name))].cocScale = scale;
    frame.world.scene = frame.scene;
    frame.world.pose = exposedPose(options, *frame.scene);

    // Camera, light, surroundings and settings.
    const PlacedCamera placed = place(frame, options);
    frame.world.lights = lightsOrDefault(*frame.scene, frame.world.pose, placed);
    frame.world.environment = chosenEnvironment(options, *frame.scene);
    frame.settings = chosenSettings(options);
    exposeMotion(options, placed, frame.settings, frame.world, frame.view);
    frame.cacheFolder = chosenCacheFolder(options);
    frame.loadMilliseconds = millisecondsSince(begin);
    return frame;
}

void addPyramids(PreparedFrame& frame, const Progress& progress) {
    const Clock::time_point begin = Clock::now();
    const std::vector<Mesh>& meshes = frame.scene->meshes;
    if (frame.settings.lod == LodMode::off) {
        frame.world.pyramids = fullDetailPyramids(meshes, progress);
    } else {
        CachedPyramids cached = cachedPyramids(meshes, frame.cacheFolder, {}, progress);
        frame.world.pyramids = std::move(cached.pyramids);
        frame.pyramidsLoaded = cached.loaded;
        frame.cacheFailure = std::move(cached.failure);
    }
    frame.pyramidMilliseconds = millisecondsSince(begin);
}

PreparedFrame prepareFrame(const SceneOptions& options, const Progress& progress) {
    PreparedFrame frame = placeFrame(options, progress);
    addPyramids(frame, progress);
    return frame;
}

std::vector<std::string> damageWarnings(const Scene& scene) {
    std::vector<std::string> lines;
    for (const Ignored& ignored : scene.ignored)
        if (ignored.damage)
            lines.push_back(fmt::format("{} {} left out: {}", grouped(ignored.count), ignored.what, ignored.reason));
    return lines;
}

std::vector<std::string> frameWarnings(const PreparedFrame& frame) {
    std::vector<std::string> lines = damageWarnings(*frame.scene);
    for (const std::string& line : frame.refusedLensValues)
        lines.push_back(fmt::format("camera '{}': {}; not used", frame.cameraName, line));
    const Lens& lens = frame.view.lens;
    if (lens.dofEnabled && lens.focusDistance * 1000 <= lens.focalLength)
        lines.push_back(
            fmt::format("a focus at {:g} m lies inside the focal length of {:g} mm, where no real lens can be focused; "
                        "are the scene's units metres?",
                        lens.focusDistance, lens.focalLength));
    if (!frame.cacheFailure.empty())
        lines.push_back(fmt::format("simplified meshes are not kept for the next run: {}", frame.cacheFailure));
    return lines;
}

}  // namespace defocus
