#pragma once
// Tone mapping from linear HDR to display values: exposure, an optional tone curve and sRGB encoding (IEC 61966-2-1).
// Tone mapping is the last step before an image is written with 8 bits or displayed.

#include "image/image.h"

namespace defocus::engine {

float srgbEncode(float linear);   // [0, 1] → [0, 1]; other values are clamped, NaN gives 0
float srgbDecode(float encoded);  // [0, 1] → [0, 1]; other values are clamped, NaN gives 0

// Returns a display-encoded copy in [0, 1] of a linear image with 1, 3 or 4 channels: colour · 2^exposure → curve →
// sRGB. AgX's curve includes the encoding. One channel is treated as grey. Alpha is clamped; premultiplied colours are
// encoded as seen over black. NaN and −∞ give 0; +∞ is treated as a very bright value.
Image displayEncoded(const ImageView& linear, ToneMap toneMap = ToneMap::none, double exposure = 0);

}  // namespace defocus::engine
