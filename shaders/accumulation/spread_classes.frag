// Of each tile, the classes of cells whose means in it may show anything, or lie beside one that does, bit k for class k. And,
// from bit besideSpread on, those of which the tile or one beside it says so: their means are read, and are zeros here.
#include "include/cells.glsl"

layout(binding = 0) uniform usampler2D heldClasses;

layout(location = 0) out uint spreadOut;

// Bits by k, of the classes on each side of the focus.
uint ofBothSides(uint classes) {
    return (classes & ((1u << CELLS_IN_FRONT) - 1u)) | (classes & ((1u << CELLS_BEHIND) - 1u)) << CELLS_IN_FRONT;
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
            // The middle of such a mean lies up to 2 · 2^k px away from what class k holds, that of one beside it 3 · 2^k px.
            spread |= held & ofBothSides(away <= 1 ? 0x1fu : away <= 2 ? 0x18u : away <= 4 ? 0x10u : 0u);
            beside |= held & ofBothSides(away <= 2 ? 0x1fu : away <= 3 ? 0x18u : 0x10u);
        }
    }
    spreadOut = spread | beside << besideSpread;
}
