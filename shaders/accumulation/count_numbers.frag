// Counts for each pixel how many samples show each object or material. An entry of the pixel's table is
// (1 + index of the object or material) · 2¹⁶ + (number of samples); 0 marks a free entry. Objects and materials for
// which no entry is free are not counted.
#include "accumulation/layer_light.glsl"

layout(r32ui, binding = 0) uniform restrict uimage2DArray table;
layout(location = 3) uniform bool startsFrame;
layout(location = 4) uniform int channel;   // 0: count objects; 1: count materials

const uint largestCount = 0xffffu;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 rim = barrelRim(pixelOnImagePlane());
    uint entries[tableEntries];
    int used = 0;
    for (int i = 0; i < tableEntries && !startsFrame; ++i) {
        entries[i] = imageLoad(table, ivec3(pixel, i)).r;
        if (entries[i] == 0u) break;
        used = i + 1;
    }
    for (int layer = 0; layer < layerCount; ++layer) {
        if (catEye > 0.0 && isClipped(layer, rim)) continue;
        uint number = uint(texelFetch(layers, ivec3(pixel, layer), 0)[channel] + 0.5);
        if (number == 0u) continue;
        int i = 0;
        while (i < used && entries[i] >> 16 != number) ++i;
        if (i == tableEntries) continue;
        if (i == used) entries[used++] = number << 16;
        if ((entries[i] & largestCount) < largestCount) ++entries[i];
    }
    for (int i = 0; i < used; ++i) imageStore(table, ivec3(pixel, i), uvec4(entries[i]));
    if (used < tableEntries) imageStore(table, ivec3(pixel, used), uvec4(0u));
}
