// The block's sum with blurred cells: lays the classes over each other from the farthest to the nearest, each blurred by linear
// interpolation between its means. What no class holds lies between what is in front of the focus and what is
// behind it. Where all samples show what is in front, nothing is known of it, and it is what they show.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;
layout(binding = 2) uniform usampler2D spreadClasses;
// Layer 0 is of what lies in front of the focus, layer 1 of what lies behind it: what a class shows, and the samples that are open to it.
layout(binding = 3) uniform sampler2DArray shownMeans;
layout(binding = 4) uniform sampler2DArray openMeans;
layout(location = 0) uniform ivec2 firstSquares;   // of class 0, columns and rows
layout(location = 1) uniform float samples;        // of the block: writes their mean. 0: the mean of those that a pixel has. −1: the sum

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

// Lays what class k of a side shows over `image`, as much as it does of what is open to it.
void layOver(inout vec3 image, int k, float side) {
    // Single pixels have means around their corners.
    vec2 square = clamp((gl_FragCoord.xy + (k == 0 ? 0.5 : 0.0)) / float(1 << k), vec2(0.5), vec2(firstSquares >> k) - 0.5);
    vec3 place = vec3((square + vec2(meansOrigin(firstSquares, k))) / vec2(textureSize(openMeans, 0).xy), side);
    vec4 shown = textureLod(shownMeans, place, 0.0);
    float open = textureLod(openMeans, place, 0.0).r;
    if (open > 1e-3) image = (shown.rgb + max(open - shown.a, 0.0) * image) / open;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 all = texelFetch(blockSum, pixel, 0);
    vec4 open = all;
    vec4 blurred = vec4(0.0);
#if CELLS_IN_FRONT > 0
    open = texelFetch(cellSums, ivec3(pixel, 0), 0);
#endif
#if CELLS_BEHIND > 0
    blurred = texelFetch(cellSums, ivec3(pixel, CELLS_IN_FRONT), 0);
#endif
    vec3 image = vec3(0.0);
    // Loops over the classes that are there cost less than branches around those that aren't: a software driver skips none.
    uint spread = texelFetch(spreadClasses, pixel / cellTile, 0).r & ((1u << cellClasses) - 1u);
    for (uint rest = spread >> CELLS_IN_FRONT; rest != 0u;) {
        int k = findMSB(rest);
        rest ^= 1u << k;
        layOver(image, k, 1.0);
    }
    if (open.a < 0.5)
        image = all.rgb / max(all.a, 1.0);
    else
        image = (max(open.rgb - blurred.rgb, 0.0) + min(blurred.a, open.a) * image) / open.a;
    for (uint rest = spread & ((1u << CELLS_IN_FRONT) - 1u); rest != 0u; rest &= rest - 1u) layOver(image, findLSB(rest), 0.0);
    sumOut = samples == 0.0 ? vec4(image, 1.0) : vec4(image * all.a, all.a) / max(samples, 1.0);
    compensationOut = vec4(0.0);
}
