#pragma once
// From a request to a world and a view that can be planned and rendered.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "frame/request.h"
#include "plan/view.h"

namespace defocus {

struct PreparedFrame {
    std::shared_ptr<Scene> scene;
    World world;
    View view;
    RenderSettings settings;
    std::string sceneName;  // the file's name, or "fish school"
    std::string cameraName;
    Lens cameraLens;                             // as it would be without the request's values
    std::vector<std::string> refusedLensValues;  // of the camera's extras, a line each
    double loadMilliseconds = 0;
    double pyramidMilliseconds = 0;
    std::filesystem::path cacheFolder;  // of the pyramids; empty: none is used
    std::size_t pyramidsLoaded = 0;     // from it
    std::string cacheFailure;           // why a pyramid couldn't be stored there
};

// The scene that a request names, or the built-in school of fish. Throws Error for a file that can't be read.
Scene loadScene(const Request& request, const Progress& progress = {});

// Loads the scene and places camera, lens and lights; the world has no pyramids yet. Throws Error for whatever the
// request asks for and the scene doesn't have.
PreparedFrame placeFrame(const Request& request, const Progress& progress = {});

// The same in a scene that is open already, with its nodes' blur as it is; it is not written to. `environment`: the
// surroundings, where they are known from a frame before; null: those that the request asks for.
PreparedFrame placeFrame(const std::shared_ptr<Scene>& scene, const Request& request,
                         const Environment* environment = nullptr);

// Scales the blur of the nodes that the request names. Throws Error for a name that the scene doesn't have.
void setNodeBlur(const Request& request, Scene& scene);

// The part of it that the request's camera and lens decide, again for another camera. The lights stay.
void placeCamera(PreparedFrame& frame, const Request& request);

// The surroundings that the request asks for. Throws Error for a map that can't be read or can't light a scene.
Environment chosenEnvironment(const Request& request, const Scene& scene);

// The image of an aperture. Throws Error for one that can't be read or lets no light pass.
std::shared_ptr<const Image> loadApertureImage(const std::filesystem::path& path);

// The near plane (m) for cameras that go where no file has put them: that of the camera they started from, or nearer
// where the scene is small.
double wanderingNearPlane(double cameraNear, const Bounds& sceneBounds);

// Where the request keeps simplified meshes; empty: nowhere.
std::filesystem::path pyramidFolder(const Request& request);

// Simplifies the meshes where the cache doesn't have them, or only brings them into the pyramids' form when the
// settings use no other level.
void addPyramids(PreparedFrame& frame, const Progress& progress = {});

// Both.
PreparedFrame prepareFrame(const Request& request, const Progress& progress = {});

// A line for each kind of damage in the scene's file.
std::vector<std::string> damageWarnings(const Scene& scene);

// That, values of the camera that aren't used, a focus that no lens has, pyramids that couldn't be stored: a line each.
std::vector<std::string> frameWarnings(const PreparedFrame& frame);

}  // namespace defocus
