// Writes two bit masks for each tile, with one bit per blur class, a group of samples with similar blur
// (include/cells.glsl). The means of a class are the radiance of its samples, averaged over squares of pixels. Bit k is
// set if a pixel of the tile may read a non-zero mean of class k. Bit besideSpread + k is set if the means of class k
// must be written in the tile, even if they are 0: interpolation in the tile or its neighbours may read them.
#include "include/cells.glsl"

layout(binding = 0) uniform usampler2D heldClasses;

layout(location = 0) out uint spreadOut;

// Returns the bit mask of the given blur classes on both sides of the focus plane. `classes` is their bit mask for one
// side.
uint ofBothSides(uint classes) {
    return (classes & ((1u << cellsInFront) - 1u)) | (classes & ((1u << cellsBehind) - 1u)) << cellsInFront;
}

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(heldClasses, 0) - 1;
    uint spread = 0u;
    uint beside = 0u;
    for (int y = -6; y <= 6; ++y) {
        for (int x = -6; x <= 6; ++x) {
            uint held = texelFetch(heldClasses, clamp(tile + ivec2(x, y), ivec2(0), last), 0).r;
            int away = max(abs(x), abs(y));
            // Blur class k is averaged over squares of 2^k px. Its means are non-zero up to 2 · 2^k px from its
            // samples. Interpolation also reads the squares next to these means, up to 3 · 2^k px from the samples. In
            // each mask, bit k is set if class k reaches tiles that are `away` tiles away.
            spread |= held & ofBothSides(away <= 1 ? 0x1fu : away <= 2 ? 0x18u : away <= 4 ? 0x10u : 0u);
            beside |= held & ofBothSides(away <= 2 ? 0x1fu : away <= 3 ? 0x18u : 0x10u);
        }
    }
    spreadOut = spread | beside << besideSpread;
}
