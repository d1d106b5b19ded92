// The block's sum with blurred cells: lays the classes over each other from the farthest to the nearest, each blurred by linear
// interpolation between its means. What no class holds lies between what is in front of the focus and what is
// behind it. Where all samples show what is in front, nothing is known of it, and it is what they show.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;
layout(binding = 2) uniform sampler2DArray means[cellClasses];   // layer 0: what it shows; layer 1, red: samples open to it

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

// Lays what class k of a side shows over `image`, as much as it does of what is open to it.
void layOver(inout vec3 image, sampler2DArray means, int k) {
    vec2 place = gl_FragCoord.xy * exp2(float(-k)) + (k == 0 ? 0.5 : 0.0);   // single pixels have means around their corners
    place /= vec2(textureSize(means, 0).xy);
    vec4 shown = textureLod(means, vec3(place, 0.0), 0.0);
    float open = textureLod(means, vec3(place, 1.0), 0.0).r;
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
    for (int k = CELLS_BEHIND - 1; k >= 0; --k) layOver(image, means[CELLS_IN_FRONT + k], k);
    if (open.a < 0.5)
        image = all.rgb / max(all.a, 1.0);
    else
        image = (max(open.rgb - blurred.rgb, 0.0) + min(blurred.a, open.a) * image) / open.a;
    for (int k = 0; k < CELLS_IN_FRONT; ++k) layOver(image, means[k], k);
    sumOut = vec4(image * all.a, all.a);
    compensationOut = vec4(0.0);
}
