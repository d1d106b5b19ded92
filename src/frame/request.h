#pragma once
// Includes the request of the public API, with what the library's own rooms need to read it.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "defocus/request.h"
#include "render/methods.h"

namespace defocus {

inline glm::dvec3 asVector(const Vector3& v) {
    return {v[0], v[1], v[2]};
}
inline Vector3 asArray(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline glm::ivec2 asVector(const Pixel& pixel) {
    return {pixel.column, pixel.row};
}

// Returns the method with its settings. Throws UsageError for settings that it doesn't take.
MethodUse chosenMethod(const Request& request);

// Is the number of samples left to the picture? Methods that don't add blocks of samples, and motion that poses the
// scene for each, take 64 instead.
bool isAutomatic(const Request& request);

// Calls checkStop (render/frame_run.h) for the request's method and shutter.
void checkStop(const Request& request);

// Throws UsageError, which names the setting, for a value out of its range and for more than one focus.
void checkRequest(const Request& request);

}  // namespace defocus
