#pragma once
// Finds the length of a scene's unit in metres. The blur needs real lengths.

#include <optional>
#include <string>

#include "frame/request.h"
#include "scene/scene.h"

namespace defocus::engine {

// Sets Scene::metresPerUnit to the request's value, else to the file's. Without either, the unit is a metre if the
// request or the camera gives a length: a focus distance, a focal length, a camera position. Otherwise
// guessedMetresPerUnit (scene/units.h) guesses it from the extent of the framed part. The scene may be scaled already.
// Throws Error for a camera or an animation that the scene doesn't have.
void setScale(const Request& request, Scene& scene);

// Returns a note that names the guessed unit of a scene; none if the unit is a metre or was given.
std::optional<std::string> guessedScaleNote(const Request& request, const Scene& scene);

}  // namespace defocus::engine
