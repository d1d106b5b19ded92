// Composites each layer of the wave over the environment, and adds the layers in order to the block's compensated sum.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/compensated.glsl"
#include "include/environment.glsl"

layout(binding = 0) uniform sampler2DArray layers;
layout(binding = 1) uniform sampler2D sumSoFar;
layout(binding = 2) uniform sampler2D compensationSoFar;
layout(std140, binding = 3) uniform ShiftBlock {
    // Shift of the sky on the image plane at distance 1. With COC_CONTROLS: the shifts for C/w = 1 and for the jitter.
    vec4 sampleShifts[BLOCK_SAMPLES];
};
#if defined(CHROMATIC) || defined(CAT_EYE)
layout(std140, binding = 4) uniform SampleBlock {
    // Colour weights, and the wavelength's change of b in C(w).
    vec4 sampleBands[BLOCK_SAMPLES];
    // xy: lens points, relative to the lens radius.
    vec4 sampleLenses[BLOCK_SAMPLES];
};
#endif
#ifdef LENS_CELLS
#include "include/cells.glsl"
layout(binding = 6) uniform sampler2DArray layerDepths;
// Sums that the render target holds.
layout(binding = 7) uniform sampler2DArray drawnSums;
// Sums that do not fit into the render target.
layout(rgba32f, binding = 0) uniform image2DArray cellSums;
// Classes that each tile holds, as a bit mask.
layout(r32ui, binding = 1) uniform uimage2D heldClasses;
// σ of the blur of a sample's image, as a fraction of |c|.
layout(location = 3) uniform float cellBlur;
#endif
layout(location = 0) uniform int layerCount;
layout(location = 1) uniform int firstInBlock;
// Pixel of the layers where the sums begin.
layout(location = 2) uniform ivec2 firstPixel;

layout(location = 0) out vec4 sumOut;
#ifdef LENS_CELLS
layout(location = 1) out vec4 cellsOut[drawnClasses];
#else
layout(location = 1) out vec4 compensationOut;
#endif

#ifdef LENS_CELLS
// Threshold of stored alpha. Alpha-blended surfaces add their alpha to the 1 of opaque surfaces and sky.
const float BLENDED_ALPHA = 1.001;

// Adds a layer's pixel to the classes of its blur.
void addToCells(inout vec4 sums[cellClasses], vec4 value, ivec3 texel, vec2 ndc) {
    float c = circleOfConfusion(texelFetch(layerDepths, texel, 0).r, ndc, vec2(1.0, 0.0));
    float variance = value.a < BLENDED_ALPHA ? max(0.0, cellBlur * cellBlur * c * c - LEAST_CELL_VARIANCE) : 0.0;
    float inFront = c < 0.0 ? variance : 0.0;
    float behind = variance - inFront;
    value.a = 1.0;
    for (int k = 0; k < CELLS_IN_FRONT; ++k) sums[k] += (1.0 - reachOfClass(inFront, k)) * value;
    for (int k = 0; k < CELLS_BEHIND; ++k) sums[CELLS_IN_FRONT + k] += reachOfClass(behind, k) * value;
}

// Returns the classes that hold a share of any of `samples`, one bit each. Their sums differ from the next class's sum
// in the number of samples.
uint heldBy(vec4 sums[cellClasses], float samples) {
    uint held = 0u;
    for (int k = 0; k < CELLS_IN_FRONT; ++k) held |= sums[k].a != (k + 1 < CELLS_IN_FRONT ? sums[k + 1].a : samples) ? 1u << k : 0u;
    for (int k = CELLS_IN_FRONT; k < cellClasses; ++k) held |= sums[k].a != (k + 1 < cellClasses ? sums[k + 1].a : 0.0) ? 1u << k : 0u;
    return held;
}
#endif

#if BACKGROUND == 2
// Returns the sky radiance that a sample sees through this pixel.
vec3 behind(vec2 imagePlane, int layer) {
#ifdef COC_CONTROLS
#ifdef CHROMATIC
    bandShift = sampleBands[firstInBlock + layer].w;
#endif
    vec2 place = imagePlane * frame.projection.xy;
    float blur = relativeCircleOfConfusion(0.0, place, vec2(1.0, 0.0));
    vec2 p = imagePlane + blur * sampleShifts[firstInBlock + layer].xy + sampleShifts[firstInBlock + layer].zw;
#ifdef ABERRATIONS
    p -= aberration(place, -sampleShifts[firstInBlock + layer].xy * frame.projection.xy) / frame.projection.xy;
#endif
#else
    vec2 p = imagePlane + sampleShifts[firstInBlock + layer].xy;
#endif
    vec3 up = vec3(frame.worldFromView[0].y, frame.worldFromView[1].y, frame.worldFromView[2].y);
    return gradientRadiance((dot(up.xy, p) - up.z) * inversesqrt(dot(p, p) + 1.0));
}
#elif BACKGROUND == 1
vec3 behind(vec2 imagePlane, int layer) { return lighting.environment[0].rgb; }
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef STARTS_BLOCK
    const bool startsBlock = true;
#else
    const bool startsBlock = false;
#endif
    vec4 sum = startsBlock ? vec4(0.0) : texelFetch(sumSoFar, pixel, 0);
#ifdef LENS_CELLS
    vec4 compensation = vec4(0.0);   // discarded: blurred sums need only single precision
#else
    vec4 compensation = startsBlock ? vec4(0.0) : texelFetch(compensationSoFar, pixel, 0);
#endif
    ivec2 layerPixel = pixel + firstPixel;
    vec2 imagePlane = (2.0 * (gl_FragCoord.xy + vec2(firstPixel) + frame.window.xy) / frame.window.zw - 1.0) / frame.projection.xy;
#ifdef CAT_EYE
    // Clips the sample at the rim of the barrel, a circle as large as the aperture. The circle shifts across the
    // aperture with the pixel's distance from the centre, by CAT_EYE radii at the image's corners. For light from the
    // right, the circle shifts to the right.
    float aspect = frame.window.z / frame.window.w;
    vec2 rim = CAT_EYE * imagePlane * frame.projection.xy * vec2(1.0, 1.0 / aspect) * inversesqrt(1.0 + 1.0 / (aspect * aspect));
    float seen = 0.0;
#else
    float seen = float(layerCount);
#endif
#ifdef LENS_CELLS
    vec2 ndc = imagePlane * frame.projection.xy;
    vec4 cells[cellClasses];
    for (int k = 0; k < drawnClasses; ++k) cells[k] = startsBlock ? vec4(0.0) : texelFetch(drawnSums, ivec3(pixel, k), 0);
    for (int k = drawnClasses; k < cellClasses; ++k) cells[k] = startsBlock ? vec4(0.0) : imageLoad(cellSums, ivec3(pixel, k));
#endif
    for (int layer = 0; layer < layerCount; ++layer) {
#ifdef CAT_EYE
        vec2 onLens = sampleLenses[firstInBlock + layer].xy + rim;
        if (dot(onLens, onLens) > 1.0) continue;
        seen += 1.0;
#endif
#ifdef CHROMATIC
        vec3 weight = sampleBands[firstInBlock + layer].rgb;
#else
        const vec3 weight = vec3(1.0);
#endif
        vec4 value = texelFetch(layers, ivec3(layerPixel, layer), 0);
#if BACKGROUND == 1 || BACKGROUND == 2
        value.rgb += (1.0 - min(value.a, 1.0)) * behind(imagePlane, layer);
#elif BACKGROUND == 0
        addCompensated(sum.a, compensation.a, value.a);
#endif
        addCompensated(sum.rgb, compensation.rgb, value.rgb * weight);
#ifdef LENS_CELLS
        addToCells(cells, value, ivec3(layerPixel, layer), ndc);
#endif
    }
#if BACKGROUND != 0
    sum.a += seen;   // integers, hence exact
#endif
#ifdef LENS_CELLS
    for (int k = 0; k < drawnClasses; ++k) cellsOut[k] = cells[k];
    for (int k = drawnClasses; k < cellClasses; ++k) imageStore(cellSums, ivec3(pixel, k), cells[k]);
    uint held = heldBy(cells, sum.a);
    ivec2 tile = pixel / cellTile;
    if ((held & ~imageLoad(heldClasses, tile).r) != 0u) imageAtomicOr(heldClasses, tile, held);
#endif
    sumOut = sum;
#ifndef LENS_CELLS
    compensationOut = compensation;
#endif
}
