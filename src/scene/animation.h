#pragma once
// Key frames at a moment: STEP, LINEAR and CUBICSPLINE as in glTF 2.0, appendix C.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include "scene/scene.h"

namespace defocus::engine {

// `count` floats of the channel at `time` (3 for translation and scale, one a target for weights). Times outside the
// keys hold the first or last value.
std::vector<double> sampleValues(const AnimationChannel& channel, std::size_t count, double time);

// The clip of that name, else that number (from 0). Throws Error listing the scene's clips.
int clipNamed(const Scene& scene, std::string_view nameOrNumber);

// `time` in [0, duration) as the clip repeats for ever.
double loopedTime(const AnimationClip& clip, double time);

// A rotation channel (x, y, z, w a key) at `time`: spherical interpolation along the shorter arc, unit length.
glm::dquat sampleRotation(const AnimationChannel& channel, double time);

}  // namespace defocus::engine
