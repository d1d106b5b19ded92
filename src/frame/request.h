#pragma once
// Converts the public Request to the settings that the folders lens, plan and render use.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "defocus/request.h"
#include "lens/lens_fields.h"
#include "plan/motion/shutter.h"
#include "plan/render_settings.h"
#include "render/methods.h"
#include "render/sampling/stop_settings.h"

namespace defocus::engine {

inline glm::dvec3 asVector(const Vector3& v) {
    return {v[0], v[1], v[2]};
}
inline Vector3 asArray(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline glm::ivec2 asVector(const Pixel& pixel) {
    return {pixel.column, pixel.row};
}

// Returns the method that the request names, with the request's settings of that method. Throws UsageError for a
// setting that the method doesn't have.
MethodUse namedMethod(const Request& request);

// Returns namedMethod(request), but "accumulation" instead of "auto" if the request has a memory limit. Only
// accumulation can draw tiles, which the limit may require. It is used even without tiles, so that the image doesn't
// depend on the limit.
MethodUse chosenMethod(const Request& request);

// Returns the settings for planning the frame. An automatic number of samples is replaced by 64.
RenderSettings renderSettings(const Request& request);
GivenThresholds givenThresholds(const Request& request);
ShutterSettings shutterSettings(const Request& request);

// Returns the conditions that end a frame. The number of samples is automatic if the request gives neither a number,
// nor a target error, nor a time limit. With exact motion, and with methods that cannot add blocks of samples, the
// number is 64 instead.
StopSettings stopSettings(const Request& request);

// Returns the lens values that the request sets, including the focus distance. Each value is in the unit of its
// LensField.
LensValues givenLensValues(const Request& request);
// Sets a lens value of the request. `value`: in the unit of `field`. Throws Error in the same cases as setLensField.
void giveLensValue(Request& request, const LensField& field, double value);

// Calls checkStop (render/frame_run.h) with the request's method and shutter.
void checkStop(const Request& request);

// Throws UsageError, with the setting's name in its message, if a value is outside the range of its setting.
void checkRequest(const Request& request);

}  // namespace defocus::engine
