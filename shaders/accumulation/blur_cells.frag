// Sums the images of a block of lens samples. Each sample represents a part of the lens, its lens cell
// (include/cells.glsl), and the sample's image is blurred as this part of the lens would blur it. The samples are
// sorted by blur into classes. A class is blurred by averaging its samples over squares of pixels and interpolating the
// averages linearly. The blurred classes are composited from farthest to nearest. Unblurred samples are composited
// between the classes behind the focus plane and the classes in front of the focus plane. If all samples of a pixel
// belong to classes in front of the focus plane, the mean of these samples replaces the unknown background.
#include "include/cells.glsl"

layout(binding = 0) uniform sampler2DArray cellSums;
layout(binding = 1) uniform sampler2D blockSum;
layout(binding = 2) uniform usampler2D spreadClasses;
// Per-pixel sums, averaged over squares of pixels by cell_means.frag. Layer 0 holds the blur classes in front of the
// focus plane, and layer 1 the classes behind it. shownMeans: radiance (rgb) and number (alpha) of the class's samples.
// openMeans: number of samples that nearer classes do not hide.
layout(binding = 3) uniform sampler2DArray shownMeans;
layout(binding = 4) uniform sampler2DArray openMeans;
// Number of columns and rows of squares for blur class 0, the least blurred class, whose squares are 1 × 1 px.
layout(location = 0) uniform ivec2 firstSquares;
// > 0: number of samples in the block, by which the sum is divided. 0: the sum is divided by the number of samples in
// the pixel. −1: the output is the undivided sum.
layout(location = 1) uniform float samples;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

// Composites blur class k over `image`. `side`: 0 for classes in front of the focus plane, 1 for classes behind it. The
// coverage of a class is the number of its samples divided by the number of all samples that nearer classes do not
// hide.
void layOver(inout vec3 image, int k, float side) {
    // The samples of blur class k are averaged over squares of 2ᵏ px per side. For class 0, the squares are centred at
    // pixel corners.
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
    if (cellsInFront > 0) open = texelFetch(cellSums, ivec3(pixel, 0), 0);
    if (cellsBehind > 0) blurred = texelFetch(cellSums, ivec3(pixel, cellsInFront), 0);
    vec3 image = vec3(0.0);
    // A loop over the blur classes in the tile is faster than a branch per class, because software drivers execute both
    // sides of a branch.
    uint spread = texelFetch(spreadClasses, pixel / cellTile, 0).r & ((1u << cellClasses) - 1u);
    for (uint rest = spread >> cellsInFront; rest != 0u;) {
        int k = findMSB(rest);
        rest ^= 1u << k;
        layOver(image, k, 1.0);
    }
    if (open.a < 0.5)
        image = all.rgb / max(all.a, 1.0);
    else
        image = (max(open.rgb - blurred.rgb, 0.0) + min(blurred.a, open.a) * image) / open.a;
    for (uint rest = spread & ((1u << cellsInFront) - 1u); rest != 0u; rest &= rest - 1u) layOver(image, findLSB(rest), 0.0);
    sumOut = samples == 0.0 ? vec4(image, 1.0) : vec4(image * all.a, all.a) / max(samples, 1.0);
    compensationOut = vec4(0.0);
}
