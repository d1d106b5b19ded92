#pragma once
// How long the units of a scene's lengths are: blur is in real millimetres, whatever units a model has.

#include <optional>
#include <string>

#include "frame/request.h"
#include "scene/scene.h"

namespace defocus::engine {

// Sets Scene::metresPerUnit to what the request says, else to what the file itself says. Without either, metres count
// if the request or the camera gives a length of the lens (a focus distance, a focal length, a place of the camera),
// and else guessedMetresPerUnit (scene/units.h) of what the image frames. The scene may be scaled already. Throws Error
// for a camera or an animation that the scene doesn't have.
void setScale(const Request& request, Scene& scene);

// Says what a scene's unit was guessed to be; nothing where it is a metre or where somebody said what it is.
std::optional<std::string> guessedScaleNote(const Request& request, const Scene& scene);

}  // namespace defocus::engine
