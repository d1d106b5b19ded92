#pragma once
// Evaluation of key frames at a time: STEP, LINEAR and CUBICSPLINE of glTF 2.0, appendix C.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include "scene/scene.h"

namespace defocus::engine {

// Returns `count` components of the channel at `time`: 3 for translation and scale, one per morph target for weights.
// Times outside the keys give the first or last value.
std::vector<double> sampleValues(const AnimationChannel& channel, std::size_t count, double time);

// Returns the index of the clip with this name, or else with this index (from 0). Throws Error that lists the scene's
// clips.
int clipNamed(const Scene& scene, std::string_view nameOrNumber);

// Wraps `time` (seconds) into [0, duration) of a repeating clip; returns 0 for clips without duration.
double loopedTime(const AnimationClip& clip, double time);

// Returns the unit quaternion of a rotation channel (x, y, z, w per key) at `time`. LINEAR keys are interpolated
// spherically along the shorter arc.
glm::dquat sampleRotation(const AnimationChannel& channel, double time);

}  // namespace defocus::engine
