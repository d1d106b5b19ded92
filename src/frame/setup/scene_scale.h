#pragma once
// Finds the length of a scene's unit in metres. The blur depends on physical lengths.

#include <optional>
#include <string>

#include "frame/request.h"
#include "scene/scene.h"

namespace defocus::engine {

// Sets Scene::metresPerUnit to the request's value, else to the file's value. If both are missing, the unit is a metre
// if the request or the camera gives a length (focus distance, focal length, camera position). Otherwise
// guessedMetresPerUnit (scene/units.h) guesses the unit from the size of the area that the image shows. An earlier
// value of Scene::metresPerUnit has no influence. Throws Error for a camera or an animation that the scene doesn't
// have.
void setScale(const Request& request, Scene& scene);

// Returns a note with the guessed unit of a scene; nullopt if the unit is a metre or was given.
std::optional<std::string> guessedScaleNote(const Request& request, const Scene& scene);

}  // namespace defocus::engine
