#pragma once
// The public Request, and its conversions to the settings of the rooms below.

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

// Returns the method with its settings. Throws UsageError for settings that it doesn't take.
MethodUse chosenMethod(const Request& request);

// Returns what a plan needs of the request. A number of samples that is open is 64 in it.
RenderSettings renderSettings(const Request& request);
GivenThresholds givenThresholds(const Request& request);
ShutterSettings shutterSettings(const Request& request);

// Returns when a frame has enough samples. The number of samples is automatic if the request leaves it open; methods
// that don't add blocks of samples, and exact motion, take 64 instead.
StopSettings stopSettings(const Request& request);

// The lens values that the request gives, its focus distance included, in the fields' units.
LensValues givenLensValues(const Request& request);
// Throws Error as setLensField does.
void giveLensValue(Request& request, const LensField& field, double value);

// Calls checkStop (render/frame_run.h) for the request's method and shutter.
void checkStop(const Request& request);

// Throws UsageError, which names the setting, for a value out of its range.
void checkRequest(const Request& request);

}  // namespace defocus::engine
