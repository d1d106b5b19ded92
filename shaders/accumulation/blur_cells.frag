// The block's sum with blurred cells: lays the classes over each other from the farthest to the nearest, each blurred by linear
// interpolation between its means. What no class holds lies between what is in front of the focus and what is
// behind it. Where all samples show what is in front, nothing is known of it, and it is what they show.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;
// 14 images of eight classes: the opens of the nearest and the farthest class are known without.
layout(binding = 2) uniform sampler2D means[cellClasses];
#if CELLS_IN_FRONT > 1
layout(binding = 10) uniform sampler2D opensInFront[CELLS_IN_FRONT - 1];
#endif
#if CELLS_BEHIND > 1
layout(binding = 13) uniform sampler2D opensBehind[CELLS_BEHIND - 1];
#endif

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

// `color` is premultiplied by how much of what is open to it shows it.
void layOver(inout vec3 image, vec4 color) { image = color.rgb + (1.0 - min(color.a, 1.0)) * image; }

// Of a class whose squares are 2^(k + 1) px wide.
vec2 placeOf(sampler2D means, int k) { return gl_FragCoord.xy / (exp2(float(k + 1)) * vec2(textureSize(means, 0))); }

vec4 premultiplied(vec4 mean, float open) { return open > 0.0 ? mean / open : vec4(0.0); }

// All samples are open to the nearest class ...
vec4 inFront(int k, float samples) {
    vec2 place = placeOf(means[k], k);
    float open = samples;
#if CELLS_IN_FRONT > 1
    if (k < CELLS_IN_FRONT - 1) open = textureLod(opensInFront[k], place, 0.0).r;
#endif
    return premultiplied(textureLod(means[k], place, 0.0), open);
}

// ... and those that are open to the farthest show it.
vec4 behind(int k) {
    vec2 place = placeOf(means[CELLS_IN_FRONT + k], k);
    vec4 mean = textureLod(means[CELLS_IN_FRONT + k], place, 0.0);
    float open = mean.a;
#if CELLS_BEHIND > 1
    if (k < CELLS_BEHIND - 1) open = textureLod(opensBehind[k], place, 0.0).r;
#endif
    return premultiplied(mean, open);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 all = texelFetch(blockSum, pixel, 0);
    vec4 sharp = all;
    float open = all.a;
    for (int k = 0; k < cellClasses; ++k) {
        vec4 cells = texelFetch(cellSums, ivec3(pixel, k), 0);
        sharp -= cells;
        if (k < CELLS_IN_FRONT) open -= cells.a;
    }
    vec3 image = vec3(0.0);
    for (int k = CELLS_BEHIND - 1; k >= 0; --k) layOver(image, behind(k));
    layOver(image, open < 0.5 ? vec4(all.rgb / max(all.a, 1.0), 1.0) : max(sharp, 0.0) / open);
    for (int k = 0; k < CELLS_IN_FRONT; ++k) layOver(image, inFront(k, all.a));
    sumOut = vec4(image * all.a, all.a);
    compensationOut = vec4(0.0);
}
