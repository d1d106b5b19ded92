#pragma once
// Converts refocus settings, from the public API or the command line, to a Refocusing.

#include <optional>
#include <string>
#include <vector>

#include "defocus/light_field.h"
#include "refocus/refocus.h"

namespace defocus::engine {

// Returns the aperture shape that lens settings give; nullopt if they give none. Throws UsageError, with the setting's
// name in its message, for a value that cannot be changed after rendering or is out of range, and Error if the aperture
// image cannot be read.
std::optional<Lens> apertureShape(const LensSettings& settings);

// Returns the focus and aperture that `settings` give; values that are not set are those of the rendered lens images.
// Throws in the same cases as apertureShape() and focusAtPixel(), and throws UsageError for a focus that is neither a
// distance nor a pixel.
Refocusing refocusingOf(const RefocusSettings& settings, LightField& field);

}  // namespace defocus::engine
