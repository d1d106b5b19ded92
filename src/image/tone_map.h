#pragma once
// From linear HDR to display values: exposure, an optional film curve, sRGB encoding (IEC 61966-2-1). Happens once, when an
// 8-bit image or a window is written.

#include <string_view>

#include "image/image.h"

namespace defocus {

enum class ToneMap {
    none,  // clip to [0, 1]
    aces,  // ACES filmic, fit by Stephen Hill (RRT and ODT)
    agx,   // AgX, Troy Sobotka, base look (polynomial fit)
};

// The enumerator of "none", "aces" or "agx"; throws Error listing the names otherwise.
ToneMap toneMapNamed(std::string_view name);

float srgbEncode(float linear);   // [0, 1] → [0, 1]; values outside are clamped, NaN gives 0
float srgbDecode(float encoded);  // [0, 1] → [0, 1]

// Display-encoded copy in [0, 1] of a 1-, 3- or 4-channel linear image: colour · 2^exposure → curve → sRGB. Alpha is kept; a
// premultiplied colour is encoded as it stands over black.
Image displayEncoded(const Image& linear, ToneMap toneMap = ToneMap::none, double exposure = 0);

}  // namespace defocus
