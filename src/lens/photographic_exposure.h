#pragma once
// Computes the photographic exposure: the factor from scene luminance to image values, given f-number, exposure time
// and sensitivity.
//
// A scene value of 1 is a luminance of 1 cd/m². glTF lights are in candela and lux, so lit surfaces are in candela per
// square metre. The exposure value at ISO 100 is EV100 = log2(N²/t · 100/S) with f-number N, exposure time t in s and
// ISO sensitivity S. The sensor saturates at a luminance of 1.2 · 2^EV100 cd/m². The factor 1.2 = 78 / (100 · 0.65)
// follows from ISO 12232's saturation-based speed (constant 78) for a lens that transmits 65 % of the light. The
// saturation luminance maps to 1, display white.
//   Lagarde and de Rousiers 2014, Moving Frostbite to Physically Based Rendering, 5.1.

#include "lens/lens.h"

namespace defocus::engine {

// Returns the exposure value at ISO 100, EV100. The lens must have an exposure time above 0.
double exposureValue100(const Lens& lens);

// Returns the exposure correction in EV, log2(1 / (1.2 · 2^EV100)); 0 without an exposure time.
double photographicExposure(const Lens& lens);

}  // namespace defocus::engine
