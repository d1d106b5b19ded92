// Like add_layers.frag, adds a batch (wave) of lens samples, one layer per sample, to the sum of the current block of
// samples. Also adds the pixel values of each sample to the sums of the blur classes into which they are sorted
// (include/cells.glsl).
#include "accumulation/layer_light.glsl"
#include "include/cells.glsl"

layout(binding = 6) uniform sampler2DArray layerDepths;
// Sums of blur classes 0 to drawnClasses − 1 before this pass; the new sums are written to `cellsOut`.
layout(binding = 7) uniform sampler2DArray drawnSums;
// Sums of the blur classes for which there are not enough colour attachments. Layers below drawnClasses are
// unused.
layout(rgba32f, binding = 0) uniform image2DArray cellSums;
// Per tile, a bit mask of the blur classes with samples in the tile.
layout(r32ui, binding = 1) uniform uimage2D heldClasses;
// σ of the Gaussian that blurs a sample's image, as a fraction of the CoC diameter.
layout(location = 3) uniform float cellBlur;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 cellsOut[drawnClasses];

// Pixels with an alpha above this threshold contain alpha-blended surfaces. Opaque surfaces and the sky give alpha 1,
// to which blended surfaces add their alpha.
const float blendedAlpha = 1.001;

// Adds `value`, the radiance of a layer's pixel, to the sums of the blur classes that match the pixel's blur.
void addToCells(inout vec4 sums[cellClasses], vec4 value, ivec3 texel) {
    vec2 ndc = onImagePlane(vec2(texel.xy) + 0.5) * frame.projection.xy;
    float c = circleOfConfusion(texelFetch(layerDepths, texel, 0).r, ndc, vec2(1.0, 0.0));
    float variance = value.a < blendedAlpha ? max(0.0, cellBlur * cellBlur * c * c - minCellVariance) : 0.0;
    float inFront = c < 0.0 ? variance : 0.0;
    float behind = variance - inFront;
    value = vec4(value.rgb, 1.0) / float(positions);
    for (int k = 0; k < cellsInFront; ++k) sums[k] += (1.0 - reachOfClass(inFront, k)) * value;
    for (int k = 0; k < cellsBehind; ++k) sums[cellsInFront + k] += reachOfClass(behind, k) * value;
}

// Returns a bit mask of the blur classes that are not empty. The sums are cumulative, so a class is not empty if its
// sum and the next class's sum have different numbers of samples. `samples` is the total number of samples in the
// pixel.
uint heldBy(vec4 sums[cellClasses], float samples) {
    uint held = 0u;
    for (int k = 0; k < cellsInFront; ++k) held |= sums[k].a != (k + 1 < cellsInFront ? sums[k + 1].a : samples) ? 1u << k : 0u;
    for (int k = cellsInFront; k < cellClasses; ++k) held |= sums[k].a != (k + 1 < cellClasses ? sums[k + 1].a : 0.0) ? 1u << k : 0u;
    return held;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = startsBlock ? vec4(0.0) : texelFetch(sumSoFar, pixel, 0);
    vec4 compensation = vec4(0.0);   // unused, because blurred sums need only single precision
    vec2 rim = barrelRim(pixelOnImagePlane());
    vec4 cells[cellClasses];
    for (int k = 0; k < drawnClasses; ++k) cells[k] = startsBlock ? vec4(0.0) : texelFetch(drawnSums, ivec3(pixel, k), 0);
    for (int k = drawnClasses; k < cellClasses; ++k) cells[k] = startsBlock ? vec4(0.0) : imageLoad(cellSums, ivec3(pixel, k));
    float seen = 0.0;
    for (int layer = 0; layer < layerCount; ++layer) {
        if (catEye > 0.0 && isClipped(layer, rim)) continue;
        seen += 1.0;
        vec4 light = vec4(0.0);
        for (int position = 0; position < positions; ++position) {
            ivec3 texel = texelOf(position, layer);
            vec4 value = layerLight(texel);
            light += value;
            addToCells(cells, value, texel);
        }
        addLayer(sum, compensation, light / float(positions), layer);
    }
    // Alpha counts the samples that the lens barrel does not block. Floats add small integers exactly, so alpha needs
    // no compensated summation.
    if (backgroundType != 0) sum.a += catEye > 0.0 ? seen : float(layerCount);
    for (int k = 0; k < drawnClasses; ++k) cellsOut[k] = cells[k];
    for (int k = drawnClasses; k < cellClasses; ++k) imageStore(cellSums, ivec3(pixel, k), cells[k]);
    uint held = heldBy(cells, sum.a);
    ivec2 tile = pixel / cellTile;
    if ((held & ~imageLoad(heldClasses, tile).r) != 0u) imageAtomicOr(heldClasses, tile, held);
    sumOut = sum;
}
