// Means around the middles of squares of pixels, weighed by a tent that ends at the next squares' middles: of what a class of cells
// shows, and of the samples that are open to it, which show nothing in front of it. So what is blurred doesn't spread beneath what
// covers it, nor does the cover's edge.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;   // alpha: samples
layout(location = 0) uniform int classIndex;      // a layer of cellSums
layout(location = 1) uniform int side;            // px of the squares, an even number

layout(location = 0) out vec4 meanOut;
layout(location = 1) out float openOut;

// All samples are open to the nearest class, and those that are open to the farthest show it: nobody asks for their opens.
float openAt(ivec2 pixel) {
    float open = 0.0;
    if (classIndex >= CELLS_IN_FRONT) {
        if (classIndex == cellClasses - 1) return 0.0;
        for (int k = classIndex; k < cellClasses; ++k) open += texelFetch(cellSums, ivec3(pixel, k), 0).a;
    } else {
        if (classIndex == CELLS_IN_FRONT - 1) return 0.0;
        open = texelFetch(blockSum, pixel, 0).a;
        for (int k = classIndex + 1; k < CELLS_IN_FRONT; ++k) open -= texelFetch(cellSums, ivec3(pixel, k), 0).a;
    }
    return open;
}

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * side - side / 2;
    ivec2 last = textureSize(blockSum, 0) - 1;
    vec4 mean = vec4(0.0);
    float open = 0.0;
    for (int y = 0; y < 2 * side; ++y) {
        for (int x = 0; x < 2 * side; ++x) {
            ivec2 pixel = clamp(first + ivec2(x, y), ivec2(0), last);
            vec2 tent = 1.0 - abs(vec2(x, y) + 0.5 - float(side)) / float(side);
            float weight = tent.x * tent.y;
            mean += weight * texelFetch(cellSums, ivec3(pixel, classIndex), 0);
            open += weight * openAt(pixel);
        }
    }
    float share = 1.0 / float(side * side);
    meanOut = mean * share;
    openOut = open * share;
}
