// Reduces one blur class of lens cells (include/cells.glsl), a group of samples with similar blur, to one tent-weighted
// mean per square of side × side px. The tent extends to the centres of the neighbouring squares. Squares of one pixel
// are centred at pixel corners, where the tent covers 2 × 2 pixels. A tent centred in a pixel would cover only that
// pixel.
//
// meanOut is the sum of the radiance (rgb) and the number (alpha) of the class's lens samples in a pixel, averaged over
// the square. openOut is the number of samples in a pixel that no nearer class hides, averaged over the square. The
// quotient meanOut / openOut is the colour and coverage of the class where it is not hidden. A blurred surface
// therefore keeps its colour and coverage up to the edges of its occluders.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;
layout(binding = 2) uniform usampler2D spreadClasses;
// Index of the blur class. If the define nearestClass is set, this is the most blurred class in front of the focus
// plane, which no other class hides.
layout(location = 0) uniform int classIndex;
// Side in px of the squares over which samples are averaged, a power of 2.
layout(location = 1) uniform int side;
// Lower left texel of the region of the render target that holds the class's means, from meansOrigin().
layout(location = 4) uniform ivec2 origin;

layout(location = 0) out vec4 meanOut;
layout(location = 1) out float openOut;

// Returns the sum of the samples at `place` that nearer blur classes don't hide.
vec4 openTo(vec2 place) {
    if (nearestClass) return textureLod(blockSum, place, 0.0);
    return textureLod(cellSums, vec3(place, float(classIndex < cellsInFront ? classIndex + 1 : classIndex)), 0.0);
}
// Returns the sum of the samples at `place` that belong neither to this blur class nor to nearer classes.
vec4 beyond(vec2 place) {
    if (nearestClass) return textureLod(cellSums, vec3(place, float(classIndex)), 0.0);
    int layer = classIndex < cellsInFront ? classIndex : classIndex + 1;
    return textureLod(cellSums, vec3(place, float(min(layer, cellClasses - 1))), 0.0) * (layer < cellClasses ? 1.0 : 0.0);
}

void main() {
    ivec2 first = (ivec2(gl_FragCoord.xy) - origin) * side - (side + 1) / 2;
    ivec2 last = textureSize(blockSum, 0) - 1;
    meanOut = vec4(0.0);
    openOut = 0.0;
    ivec2 tile = clamp(first + side, ivec2(0), last) / cellTile;
    if ((texelFetch(spreadClasses, tile, 0).r & 1u << classIndex) == 0u) return;
    vec4 mean = vec4(0.0);
    float open = 0.0;
    // One bilinear fetch reads a weighted mean of 2 × 2 pixels, which quarters the number of fetches.
    vec2 perPixel = 1.0 / vec2(textureSize(blockSum, 0));
    for (int y = 0; y < 2 * side; y += 2) {
        for (int x = 0; x < 2 * side; x += 2) {
            vec2 low = 1.0 - abs(vec2(x, y) + 0.5 - float(side)) / float(side);
            vec2 high = 1.0 - abs(vec2(x, y) + 1.5 - float(side)) / float(side);
            vec2 place = (vec2(first + ivec2(x, y)) + 0.5 + high / (low + high)) * perPixel;
            float weight = (low.x + high.x) * (low.y + high.y);
            vec4 all = openTo(place);
            mean += weight * (all - beyond(place));
            open += weight * all.a;
        }
    }
    float share = 1.0 / float(side * side);
    meanOut = mean * share;
    openOut = open * share;
}
