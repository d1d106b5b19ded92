#pragma once
// From linear HDR to display values: exposure, an optional film curve, sRGB encoding (IEC 61966-2-1). Happens once,
// when an 8-bit image or a window is written.

#include <string_view>

#include "image/image.h"

namespace defocus::engine {

// The enumerator of "none", "aces", "agx" or "neutral"; throws Error listing the names otherwise.
ToneMap toneMapNamed(std::string_view name);

float srgbEncode(float linear);   // [0, 1] → [0, 1]; values outside are clamped, NaN gives 0
float srgbDecode(float encoded);  // [0, 1] → [0, 1]; the same for values outside

// Display-encoded copy in [0, 1] of a 1-, 3- or 4-channel linear image: colour · 2^exposure → curve → sRGB (AgX's curve
// is the encoding). A grey value counts as that grey. Alpha is kept, clamped; a premultiplied colour is encoded as it
// stands over black. NaN and −∞ give 0, +∞ what a very bright colour gives.
Image displayEncoded(const ImageView& linear, ToneMap toneMap = ToneMap::none, double exposure = 0);

}  // namespace defocus::engine
