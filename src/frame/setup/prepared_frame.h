#pragma once
// Makes a world and a view of a request, so that they can be planned and rendered.

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
    std::vector<PlacedLight> ownLights;  // the world's, of the sizes that the file or the studio gives them
    View view;
    RenderSettings settings;
    std::string sceneName;                 // the file's name, or "fish school"
    std::optional<std::string> scaleNote;  // what the scene's unit was guessed to be; none: nobody guessed
    std::string cameraName;
    Lens cameraLens;                             // the lens without the request's values
    std::vector<std::string> refusedLensValues;  // of the camera's extras, a line each
    double loadMilliseconds = 0;
    double pyramidMilliseconds = 0;
    std::filesystem::path cacheFolder;  // of the pyramids; empty: none is used
    std::size_t pyramidsLoaded = 0;     // from it
    std::string cacheFailure;           // why a pyramid couldn't be stored there
};

// Loads the scene that a request names, or makes the built-in school of fish. Throws Error for a file that can't be
// read.
Scene loadScene(const Request& request, const Progress& progress = {});

// Loads the scene and places camera, lens and lights; the world has no pyramids yet. Throws Error for whatever the
// request asks for and the scene doesn't have.
PreparedFrame placeFrame(const Request& request, const Progress& progress = {});

// Does the same in a scene that is loaded already. The scene isn't changed, so its nodes keep the blur they have, and
// its units the length.
// `environment`: the surroundings, if they are known from an earlier frame; null: those that the request asks for.
PreparedFrame placeFrame(const std::shared_ptr<Scene>& scene, const Request& request,
                         const Environment* environment = nullptr);

// Scales the blur of the nodes that the request names. Throws Error for a name that the scene doesn't have.
void setNodeBlur(const Request& request, Scene& scene);

// Adds the ground that the request asks for, unless the scene has it: beneath the scene as it is when its animation
// begins, so that all frames of a film stand on the same one. The scene's units must be set.
void setGround(const Request& request, Scene& scene);

// Returns `own`, where `pose` has moved them, with the sizes that the request asks for.
std::vector<PlacedLight> sizedLights(const Request& request, const std::vector<PlacedLight>& own, const Pose& pose);

// Sets camera and lens of a placed frame anew, for a request with another camera. The lights stay.
void placeCamera(PreparedFrame& frame, const Request& request);

// Returns the surroundings that the request asks for. A sky that nobody asked for fits the scene's own lights. Throws
// Error for a map that can't be read or can't light a scene.
Environment chosenEnvironment(const Request& request, const Scene& scene, const Pose& pose);

// Loads the image of an aperture. Throws Error for one that can't be read or lets no light pass.
std::shared_ptr<const Image> loadApertureImage(const std::filesystem::path& path);

// Returns the near plane (m) for cameras that go where no file has put them: that of the camera they started from, or a
// nearer one if the scene is small.
double wanderingNearPlane(double cameraNear, const Bounds& sceneBounds);

// Returns the folder in which the request keeps simplified meshes; empty if it keeps none.
std::filesystem::path pyramidFolder(const Request& request);

// Simplifies the meshes that the cache doesn't have. If the settings use full detail only, makes pyramids of level 0
// alone.
void addPyramids(PreparedFrame& frame, const Progress& progress = {});

// Calls placeFrame, then addPyramids.
PreparedFrame prepareFrame(const Request& request, const Progress& progress = {});

// Returns a line for each kind of damage in the scene's file.
std::vector<std::string> damageWarnings(const Scene& scene);

// Returns the lines of damageWarnings, what the scene's unit was guessed to be, and one for each value of the camera
// that isn't used, for a focus that no lens has, and for pyramids that couldn't be stored.
std::vector<std::string> frameWarnings(const PreparedFrame& frame);

}  // namespace defocus::engine
