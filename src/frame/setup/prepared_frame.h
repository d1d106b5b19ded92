#pragma once
// Builds the world and the view of a request, ready for planning and rendering.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/request.h"
#include "plan/view.h"

namespace defocus::engine {

struct PreparedFrame {
    std::shared_ptr<Scene> scene;
    World world;
    std::vector<PlacedLight> ownLights;  // lights before the request's light sizes are applied
    View view;
    RenderSettings settings;
    std::string sceneName;                 // file name, "fish school", or the name of a scene without a file
    std::optional<std::string> scaleNote;  // note for the user about the guessed unit of the scene; nullopt: no guess
    std::string cameraName;
    Lens cameraLens;  // lens of the scene's camera, before the request's lens settings are applied
    std::vector<std::string> refusedLensValues;  // messages about invalid values in the camera's extras
    double loadMilliseconds = 0;
    double pyramidMilliseconds = 0;
    std::filesystem::path cacheFolder;  // cache of the pyramids; empty: no cache
    std::uint64_t memoryLimit = 0;      // memory limit of the process, in bytes, while pyramids are built; 0: no limit
    std::size_t pyramidsLoaded = 0;     // number of pyramids read from the cache
    std::string cacheFailure;           // why a pyramid couldn't be stored; empty: no failure
};

// Loads the scene and places camera, lens and lights. The levels of detail (World::pyramids) are not yet built. Throws
// Error if the request names an object, camera or animation that the scene doesn't have.
PreparedFrame placeFrame(const Request& request, const Progress& progress = {});

// Places camera, lens and lights for a scene that SharedScene::of (shared_scene.h) returned for this request.
// `environment`: environment map to reuse; null: load the request's map.
PreparedFrame placeFrame(const std::shared_ptr<Scene>& scene, const Request& request,
                         const Environment* environment = nullptr);

// Returns the scene's own lights `own`, moved to the scene pose `pose` and with the light sizes that the request sets.
std::vector<PlacedLight> sizedLights(const Request& request, const std::vector<PlacedLight>& own, const Pose& pose);

// Updates the camera and lens of a frame that placeFrame() returned, for a request that differs from the frame's
// request only in the camera. The lights stay unchanged.
void placeCamera(PreparedFrame& frame, const Request& request);

// Returns the request's environment. A default sky is scaled to the brightness of the scene's own lights. Throws Error
// for a map that can't be read or contains infinity.
Environment chosenEnvironment(const Request& request, const Scene& scene, const Pose& pose);

// Loads an aperture image. Throws Error for an image that can't be read or is entirely black.
std::shared_ptr<const Image> loadApertureImage(const std::filesystem::path& path);

// Returns the near plane (m) for a camera that the user moves: `cameraNear`, or a smaller distance if the scene is
// small.
double wanderingNearPlane(double cameraNear, const Bounds& sceneBounds);

// Returns the cache folder for simplified meshes; empty if the request disables the cache.
std::filesystem::path pyramidFolder(const Request& request);

// Reads the meshes' pyramids from the cache and builds the missing ones. With LodMode::off, builds pyramids that have
// full detail only. Throws Error if a pyramid doesn't fit into the request's memory limit.
void addPyramids(PreparedFrame& frame, const Progress& progress = {});

// Prepares a still image: calls placeFrame, chooseLevels (levels.h) and addPyramids.
PreparedFrame prepareFrame(const Request& request, const Progress& progress = {});

// Returns a line for each missing or damaged part of the scene's file, up to 20 lines, and a line with the number of
// parts that are not listed.
std::vector<std::string> damageWarnings(const Scene& scene);

// Returns one line per entry of Scene::ignored, such as "3 × points: not supported".
std::vector<std::string> ignoredLines(const Scene& scene);

// Returns all warnings about a prepared frame: a damaged scene file, a guessed unit, a scene too large or too small,
// invalid lens values in the camera's extras, a focus distance that does not exceed the focal length, too many lights,
// and pyramids that couldn't be stored.
std::vector<std::string> frameWarnings(const PreparedFrame& frame);

}  // namespace defocus::engine
