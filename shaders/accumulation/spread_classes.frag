// Of each tile, the classes of cells whose means in it may show anything, or lie beside one that does, bit k for class k. And,
// from bit besideSpread on, those of which the tile or one beside it says so: their means are read, and are zeros here.
#include "include/cells.glsl"

layout(binding = 0) uniform usampler2D heldClasses;

layout(location = 0) out uint spreadOut;

const uint allClasses = (1u << cellClasses) - 1u;
// The middle of such a mean lies up to 2 · 2^k px away from what class k holds: one tile, or two where k is 4.
const uint widest = allClasses & ((1u << 4) << CELLS_IN_FRONT | (CELLS_IN_FRONT > 4 ? 1u << 4 : 0u));

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(heldClasses, 0) - 1;
    uint spread = 0u;
    uint beside = 0u;
    for (int y = -3; y <= 3; ++y) {
        for (int x = -3; x <= 3; ++x) {
            uint held = texelFetch(heldClasses, clamp(tile + ivec2(x, y), ivec2(0), last), 0).r;
            int away = max(abs(x), abs(y));
            spread |= held & (away < 2 ? allClasses : away < 3 ? widest : 0u);
            beside |= held & (away < 3 ? allClasses : widest);
        }
    }
    spreadOut = spread | beside << besideSpread;
}
