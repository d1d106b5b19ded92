#pragma once
// Interpolates key frames with the modes STEP, LINEAR and CUBICSPLINE of glTF 2.0, appendix C.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include "scene/scene.h"

namespace defocus::engine {

// Returns the value of an animation channel at `time` (seconds). `count` is the number of components: 3 for translation
// and scale, one per morph target for weights. Times outside the keys give the first or last value.
std::vector<double> sampleValues(const AnimationChannel& channel, std::size_t count, double time);

// Returns the index of the animation clip whose name or index (from 0) is `nameOrNumber`; names take precedence. Throws
// Error, with a list of the scene's clips, if there is no such clip.
int clipNamed(const Scene& scene, std::string_view nameOrNumber);

// Returns `time` (seconds) modulo the clip's duration, for a repeating clip; 0 if the duration is 0.
double loopedTime(const AnimationClip& clip, double time);

// Returns the unit quaternion of a rotation channel (x, y, z, w per key) at `time`. LINEAR keys are interpolated
// spherically along the shorter arc.
glm::dquat sampleRotation(const AnimationChannel& channel, double time);

}  // namespace defocus::engine
