#include "frame/setup/prepared_frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "core/suggestion.h"
#include "frame/setup/focus.h"
#include "frame/setup/levels.h"
#include "frame/setup/moment.h"
#include "frame/setup/scene_scale.h"
#include "frame/setup/shared_scene.h"
#include "image/image_io.h"
#include "lens/aperture.h"
#include "lens/camera_lens.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/cache.h"
#include "lod/pyramid/finish.h"
#include "scene/built_in_environment.h"
#include "scene/hidden_nodes.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxDamage = 20;  // maximum number of lines in damageWarnings

[[noreturn]] void failForEnvironment(const std::string& name) {
    const std::vector<std::string> names(builtInEnvironments().begin(), builtInEnvironments().end());
    const std::string nearest = nearestWord(name, names);
    fail("--environment: there is no file '{}' and no built-in environment of this name; the built-in ones are {}{}",
         name, fmt::join(names, ", "), nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

std::shared_ptr<const Image> loadEnvironment(const std::filesystem::path& path, double rotation) {
    const bool builtIn = isBuiltInEnvironment(path.string());
    if (!builtIn && !std::filesystem::exists(path)) failForEnvironment(path.string());
    Image map = builtIn ? builtInEnvironment(path.string()) : readImage(path);
    for (const float value : map.pixels)
        if (std::isinf(value))
            fail(
                "{}: some pixel values are infinite, so it cannot be used as an environment map; clamp them or choose "
                "another file",
                path.string());
    return std::make_shared<Image>(rotation == 0 ? std::move(map) : turnedEnvironment(map, glm::radians(rotation)));
}

void brighten(Environment& environment, double scale) {
    for (glm::vec3* radiance : {&environment.zenith, &environment.horizon, &environment.nadir})
        *radiance *= static_cast<float>(scale);
}

// Returns the lens without its focus distance, which depends on the view. Messages about invalid values in the camera's
// extras are stored in `refused`. `folder`: folder of the scene's file.
Lens chosenLens(const Request& request, const Camera& camera, const std::filesystem::path& folder,
                std::vector<std::string>& refused) {
    const LensValues given = givenLensValues(request);
    Lens lens;
    refused = setLensFields(lens, camera.lens);
    setLensFields(lens, given);
    fitToCamera(lens, camera, static_cast<double>(request.size.width) / request.size.height,
                [&](std::string_view name) { return given.contains(name) || camera.lens.contains(name); });
    if (!request.lens.apertureImage.empty()) {
        lens.apertureImage = loadApertureImage(request.lens.apertureImage);
    } else if (!camera.apertureImage.empty()) {
        try {
            lens.apertureImage = loadApertureImage(fileWithin(folder, camera.apertureImage));
        } catch (const Error& error) {
            refused.emplace_back(error.what());
        }
    }
    return lens;
}

// Returns the camera's matrix with the position, target and up direction that the request gives.
glm::dmat4 wanderedCamera(const Request& request, const glm::dmat4& worldFromCamera) {
    const auto orElse = [](const std::optional<Vector3>& given, const glm::dvec3& fallback) {
        return given ? asVector(*given) : fallback;
    };
    const glm::dvec3 position = orElse(request.cameraPosition, worldFromCamera[3]);
    const glm::dvec3 back =
        request.cameraTarget ? position - asVector(*request.cameraTarget) : glm::dvec3(worldFromCamera[2]);
    const glm::dvec3 up =
        orElse(request.cameraUp, request.cameraTarget ? glm::dvec3(0, 1, 0) : glm::dvec3(worldFromCamera[1]));
    const glm::dvec3 aside = glm::cross(up, back);
    if (!(glm::length(back) > 0)) fail("--camera-target must differ from the position of the camera; move one of them");
    if (!(glm::length(aside) > 1e-9 * glm::length(up) * glm::length(back)))
        fail("--camera-up must not be parallel to the viewing direction; give another direction");
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 x = glm::normalize(aside);
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

// Returns the tangent of half the horizontal angle of view that the request's focal length gives; nullopt if the
// request has no focal length.
std::optional<double> requestedTanHalfHorizontal(const LensSettings& given) {
    if (!given.focalLength) return {};
    Lens lens;
    lens.focalLength = *given.focalLength;
    lens.horizontalAperture = given.horizontalAperture.value_or(lens.horizontalAperture);
    return tanHalfHorizontalFov(lens);
}

// Places the camera and its lens. The focus is chosen last, because it may depend on all other values.
PlacedCamera place(PreparedFrame& frame, const Request& request) {
    const double aspect = static_cast<double>(request.size.width) / request.size.height;
    PlacedCamera placed =
        chooseCamera(*frame.scene, frame.world.pose, request.camera, aspect, requestedTanHalfHorizontal(request.lens));
    frame.cameraName = placed.camera.name;
    frame.view.worldFromCamera = placed.worldFromCamera;
    frame.view.nearPlane = placed.camera.znear;
    if (request.cameraPosition || request.cameraTarget || request.cameraUp) {
        frame.view.worldFromCamera = wanderedCamera(request, placed.worldFromCamera);
        frame.view.nearPlane = wanderingNearPlane(placed.camera.znear, frame.world.pose.bounds);
    }
    frame.view.width = request.size.width;
    frame.view.height = request.size.height;
    Request withoutLens = request;
    withoutLens.lens = {};
    withoutLens.focus = CameraFocus{};
    const std::filesystem::path folder = frame.scene->file.parent_path();
    frame.cameraLens = chosenLens(withoutLens, placed.camera, folder, frame.refusedLensValues);
    frame.view.lens = chosenLens(request, placed.camera, folder, frame.refusedLensValues);
    chooseFocus(request, placed.camera, *frame.scene, frame.world.pose, frame.view);
    checkLens(frame.view.lens);
    if (request.lens.iso && frame.view.lens.exposureTime == 0)
        frame.refusedLensValues.emplace_back("--iso has no effect without --exposure-time");
    return placed;
}

}  // namespace

std::shared_ptr<const Image> loadApertureImage(const std::filesystem::path& path) {
    Lens lens;
    lens.apertureImage = std::make_shared<Image>(readImage(path));
    try {
        static_cast<void>(makeAperture(lens));  // throws Error for an unusable aperture image
    } catch (const Error& error) {
        fail("{}: {}", path.string(), error.what());
    }
    return lens.apertureImage;
}

Environment chosenEnvironment(const Request& request, const Scene& scene, const Pose& pose) {
    Environment environment = environmentOrDefault(scene);
    if (!scene.environment) brighten(environment, skyScale(pose));
    if (!request.environment.empty()) {
        environment = {};
        environment.type = EnvironmentType::map;
        environment.map = loadEnvironment(request.environment, request.environmentRotation);
    }
    if (std::holds_alternative<TransparentBackground>(request.background)) environment.visible = false;
    if (const auto* const color = std::get_if<Color>(&request.background)) {
        environment = {};
        environment.type = EnvironmentType::uniform;
        environment.zenith = environment.horizon = environment.nadir = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
    }
    return environment;
}

double wanderingNearPlane(double cameraNear, const Bounds& sceneBounds) {
    const double radius = 0.5 * glm::length(sceneBounds.size());
    return radius > 0 ? std::min(cameraNear, 1e-3 * radius) : cameraNear;
}

void placeCamera(PreparedFrame& frame, const Request& request) {
    place(frame, request);
}

PreparedFrame placeFrame(const Request& request, const Progress& progress) {
    const Clock::time_point begin = Clock::now();
    PreparedFrame frame = placeFrame(SharedScene(request, progress).of(request), request);
    frame.loadMilliseconds = millisecondsSince(begin);
    return frame;
}

std::vector<PlacedLight> sizedLights(const Request& request, const std::vector<PlacedLight>& own, const Pose& pose) {
    std::vector<PlacedLight> lights = movedLights(own, pose);
    for (PlacedLight& placed : lights) {
        if (request.lightAngle) placed.light.angularDiameter = static_cast<float>(glm::radians(*request.lightAngle));
        if (request.lightRadius) placed.light.radius = static_cast<float>(*request.lightRadius);
    }
    return lights;
}

PreparedFrame placeFrame(const std::shared_ptr<Scene>& scene, const Request& request, const Environment* environment) {
    PreparedFrame frame;
    frame.scene = scene;
    frame.scaleNote = guessedScaleNote(request, *scene);
    frame.sceneName = scene->file.empty() ? scene->name : scene->file.filename().string();
    if (scene->school) frame.sceneName = "fish school";
    frame.world.scene = scene;
    frame.world.pose = exposedPose(request, *frame.scene);

    const PlacedCamera placed = place(frame, request);
    // An environment that the request names replaces the default lights.
    frame.ownLights =
        request.environment.empty() ? lightsOrDefault(*frame.scene, frame.world.pose, placed) : frame.world.pose.lights;
    frame.world.lights = sizedLights(request, frame.ownLights, frame.world.pose);
    frame.world.environment =
        environment != nullptr ? *environment : chosenEnvironment(request, *scene, frame.world.pose);
    frame.settings = renderSettings(request);
    exposeMotion(request, placed, frame.settings, frame.world, frame.view);
    frame.memoryLimit = request.memory.value_or(0);
    // Without levels of detail, a pyramid holds only the mesh and is not worth caching.
    if (request.lod != LodMode::off) frame.cacheFolder = pyramidFolder(request);
    return frame;
}

std::filesystem::path pyramidFolder(const Request& request) {
    if (request.noCache) return {};
    return request.cacheFolder.empty() ? defaultCacheFolder() : request.cacheFolder;
}

void addPyramids(PreparedFrame& frame, const Progress& progress) {
    const Clock::time_point begin = Clock::now();
    const std::vector<Mesh>& meshes = frame.scene->meshes;
    PyramidOptions options;
    options.memoryLimit = frame.memoryLimit;
    if (frame.settings.lod == LodMode::off) {
        options.maxLevels = 1;
        frame.world.pyramids = buildPyramids(meshes, options, progress);
    } else {
        options.vertices = frame.settings.levelVertices;
        const Finishes finishes(*frame.scene);
        options.finishes = &finishes;
        CachedPyramids cached = cachedPyramids(meshes, frame.cacheFolder, options, progress);
        frame.world.pyramids = std::move(cached.pyramids);
        frame.pyramidsLoaded = cached.loaded;
        frame.cacheFailure = std::move(cached.failure);
    }
    frame.pyramidMilliseconds = millisecondsSince(begin);
}

PreparedFrame prepareFrame(const Request& request, const Progress& progress) {
    PreparedFrame frame = placeFrame(request, progress);
    chooseLevels(frame, request);
    addPyramids(frame, progress);
    return frame;
}

std::vector<std::string> damageWarnings(const Scene& scene) {
    std::vector<std::string> lines;
    std::uint64_t more = 0;
    for (const Ignored& ignored : scene.ignored) {
        if (!ignored.damage) continue;
        if (lines.size() == maxDamage)
            more += ignored.count;
        else
            lines.push_back(fmt::format("{} {} left out: {}", grouped(ignored.count), ignored.what, ignored.reason));
    }
    if (more > 0) lines.push_back(fmt::format("{} more damaged parts left out", grouped(more)));
    return lines;
}

std::vector<std::string> ignoredLines(const Scene& scene) {
    std::vector<std::string> lines;
    for (const Ignored& entry : scene.ignored)
        lines.push_back(entry.count > 1 ? fmt::format("{} × {}: {}", grouped(entry.count), entry.what, entry.reason)
                                        : fmt::format("{}: {}", entry.what, entry.reason));
    return lines;
}

// Limits of the scene's size that keep squared lengths within the range of 32-bit floats.
constexpr double largestScene = 1e15;    // m
constexpr double smallestScene = 1e-15;  // m

std::vector<std::string> frameWarnings(const PreparedFrame& frame) {
    std::vector<std::string> lines = damageWarnings(*frame.scene);
    if (frame.scaleNote) lines.push_back(*frame.scaleNote);
    if (const auto& track = frame.scene->cameraTrack)
        lines.insert(lines.end(), track->warnings.begin(), track->warnings.end());
    for (const std::string& line : frame.refusedLensValues)
        lines.push_back(fmt::format("camera '{}': {}; the value is ignored", frame.cameraName, line));
    const Lens& lens = frame.view.lens;
    if (lens.dofEnabled && lens.focusDistance * 1000 <= lens.focalLength)
        lines.push_back(
            fmt::format("the focus distance of {:g} m does not exceed the focal length of {:g} mm, which no real lens "
                        "allows; check --units",
                        lens.focusDistance, lens.focalLength));
    if (const Bounds& bounds = frame.world.pose.bounds; !bounds.empty()) {
        const glm::dvec3 reach = glm::max(glm::abs(bounds.minimum), glm::abs(bounds.maximum));
        const double farthest = std::max({reach.x, reach.y, reach.z});
        if (farthest > largestScene || farthest < smallestScene)
            lines.push_back(
                fmt::format("the scene extends {:.2g} m from its origin; content beyond {:g} m, or smaller than {:g} "
                            "m, may be drawn incorrectly; check --units",
                            farthest, largestScene, smallestScene));
    }
    if (const Pose& pose = frame.world.pose; pose.faintLights > 0)
        lines.push_back(fmt::format("the scene has {} lights; only the {} brightest are used",
                                    pose.lights.size() + pose.faintLights, pose.lights.size()));
    if (!frame.cacheFailure.empty())
        lines.push_back(fmt::format("simplified meshes are not cached: {}", frame.cacheFailure));
    return lines;
}

}  // namespace defocus::engine
