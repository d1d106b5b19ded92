#pragma once
// Exposure as a camera has it: from f-number, time and sensitivity to the factor between a scene's luminance and an
// image's values.
//
// A scene's value of 1 is a luminance of 1 cd/m² (glTF's lights are in candela and lux, so that what they light is in
// candela per square metre). The exposure value of a lens at ISO 100 is EV100 = log2(N²/t · 100/S), and the luminance
// that saturates the sensor is 1.2 · 2^EV100 cd/m² (ISO 12232's saturation-based speed with a lens that passes 65 % of
// the light: 78 / (100 · 0.65) = 1.2). That luminance becomes 1, display white.
//   Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering, 5.1.

#include "lens/lens.h"

namespace defocus::engine {

// EV100; the lens must have an exposure time above 0.
double exposureValue100(const Lens& lens);

// EV by which an image is brightened, log2(1 / (1.2 · 2^EV100)); 0 without an exposure time.
double photographicExposure(const Lens& lens);

}  // namespace defocus::engine
