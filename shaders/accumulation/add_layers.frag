// Composes each of the wave's layers over the environment and adds them, one after the other in order, to the compensated sum of
// the block. EMPTY_LAYERS: nothing was drawn into them here. MIXED_LAYERS: each is composed of one with the
// image's own pixels (where OWN_LAYERS) and of those with pixels that are LARGE_RATE_0 and LARGE_RATE_1 times larger.
#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/layer_format.glsl"
#include "include/compensated.glsl"
#include "include/environment.glsl"

#ifdef LAYER_RGB9E5
layout(binding = 0) uniform usampler2DArray layers;
#else
layout(binding = 0) uniform sampler2DArray layers;
#endif
layout(binding = 1) uniform sampler2D sumSoFar;
layout(binding = 2) uniform sampler2D compensationSoFar;
layout(std140, binding = 3) uniform ShiftBlock {
    vec4 sampleShifts[BLOCK_SAMPLES];   // of the sky on the image plane at distance 1; COC_CONTROLS: by C/w = 1, by jitter
};
#if defined(CHROMATIC) || defined(CAT_EYE)
layout(std140, binding = 4) uniform SampleBlock {
    vec4 sampleBands[BLOCK_SAMPLES];    // colour weights; what the wavelength adds to b of C(w)
    vec4 sampleLenses[BLOCK_SAMPLES];   // xy: points on the lens, in radii
};
#endif
#ifdef MIXED_LAYERS
#include "include/large_pixels.glsl"
#ifdef LAYER_RGB9E5
#define LAYER_SAMPLER usampler2DArray
#else
#define LAYER_SAMPLER sampler2DArray
#endif
layout(binding = 3) uniform sampler2DArray depths;
#ifdef LARGE_RATE_0
layout(binding = 4) uniform LAYER_SAMPLER largeLayers0;
layout(binding = 6) uniform sampler2DArray largeDepths0;
#endif
#ifdef LARGE_RATE_1
layout(binding = 7) uniform LAYER_SAMPLER largeLayers1;
layout(binding = 8) uniform sampler2DArray largeDepths1;
#endif
#endif
layout(location = 0) uniform int layerCount;
layout(location = 1) uniform int firstInBlock;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

#if BACKGROUND == 2
// The sky that a sample sees through this pixel.
vec3 behind(vec2 imagePlane, int layer) {
#ifdef COC_CONTROLS
#ifdef CHROMATIC
    bandShift = sampleBands[firstInBlock + layer].w;
#endif
    float blur = relativeCircleOfConfusion(0.0, imagePlane * frame.projection.xy, 1.0);
    vec2 p = imagePlane + blur * sampleShifts[firstInBlock + layer].xy + sampleShifts[firstInBlock + layer].zw;
#else
    vec2 p = imagePlane + sampleShifts[firstInBlock + layer].xy;
#endif
    vec3 up = vec3(frame.worldFromView[0].y, frame.worldFromView[1].y, frame.worldFromView[2].y);
    return gradientRadiance((dot(up.xy, p) - up.z) * inversesqrt(dot(p, p) + 1.0));
}
#elif BACKGROUND == 1
vec3 behind(vec2 imagePlane, int layer) { return lighting.environment[0].rgb; }
#endif

#ifdef MIXED_LAYERS
vec4 valueOf(LAYER_SAMPLER layerArray, ivec3 texel) {
#ifdef LAYER_RGB9E5
    uint bits = texelFetch(layerArray, texel, 0).r;
    return bits == 0u ? vec4(0.0) : decodeLayer(bits);
#else
    return texelFetch(layerArray, texel, 0);
#endif
}

vec4 over(vec4 nearer, vec4 farther) { return nearer + (1.0 - nearer.a) * farther; }

// Larger pixels, interpolated: of those that are nearer than a depth and of the others, with the mean depth of all times the coverage.
struct Interpolated {
    vec4 nearer;
    vec4 farther;
    float depth;
};

Interpolated interpolated(LAYER_SAMPLER layerArray, sampler2DArray depthArray, LargePixels around, int layer, float than) {
    Interpolated result = Interpolated(vec4(0.0), vec4(0.0), 0.0);
    for (int i = 0; i < 4; ++i) {
        ivec3 texel = ivec3(around.texel + ivec2(i & 1, i >> 1), layer);
        vec4 value = around.weights[i] * valueOf(layerArray, texel);
        float depth = texelFetch(depthArray, texel, 0).r;
        if (depth > than)
            result.nearer += value;
        else
            result.farther += value;
        result.depth += value.a * depth;
    }
    return result;
}

// Of the larger pixels around, those that are nearer than what the image's own pixel shows cover it, and those that are farther are
// covered by it. So what is in front keeps its outline, at its own size.
vec4 composed(ivec2 pixel, int layer) {
#ifdef OWN_LAYERS
    vec4 own = valueOf(layers, ivec3(pixel, layer));
    float depth = texelFetch(depths, ivec3(pixel, layer), 0).r;
#else
    const vec4 own = vec4(0.0);
    const float depth = 0.0;
#endif
#ifdef LARGE_RATE_0
    Interpolated first = interpolated(largeLayers0, largeDepths0, largePixels(pixel, float(LARGE_RATE_0)), layer, depth);
#ifndef LARGE_RATE_1
    return over(first.nearer, over(own, first.farther));
#endif
#endif
#ifdef LARGE_RATE_1
    Interpolated second = interpolated(largeLayers1, largeDepths1, largePixels(pixel, float(LARGE_RATE_1)), layer, depth);
#ifndef LARGE_RATE_0
    return over(second.nearer, over(own, second.farther));
#else
    // Both are blurred: that of the two which is nearer on the whole lies before the other.
    bool firstIsNearer = first.depth * (second.nearer.a + second.farther.a) >= second.depth * (first.nearer.a + first.farther.a);
    vec4 nearer = firstIsNearer ? over(first.nearer, second.nearer) : over(second.nearer, first.nearer);
    vec4 farther = firstIsNearer ? over(first.farther, second.farther) : over(second.farther, first.farther);
    return over(nearer, over(own, farther));
#endif
#endif
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool startsBlock = firstInBlock == 0;
    vec4 sum = startsBlock ? vec4(0.0) : texelFetch(sumSoFar, pixel, 0);
    vec4 compensation = startsBlock ? vec4(0.0) : texelFetch(compensationSoFar, pixel, 0);
    vec2 ndc = 2.0 * gl_FragCoord.xy / vec2(textureSize(layers, 0).xy) - 1.0;
#ifdef PIXEL_RATE
    ndc = (ndc - frame.pixelGrid.zw) / frame.pixelGrid.xy;
#endif
    vec2 imagePlane = ndc / frame.projection.xy;
#ifdef CAT_EYE
    // The rim of the barrel: a circle as large as the aperture that moves over it the farther the pixel lies from the centre, by
    // CAT_EYE radii at the image's corners. Light from the right meets it on the right.
    float aspect = float(textureSize(layers, 0).x) / float(textureSize(layers, 0).y);
    vec2 rim = CAT_EYE * imagePlane * frame.projection.xy * vec2(1.0, 1.0 / aspect) * inversesqrt(1.0 + 1.0 / (aspect * aspect));
    float seen = 0.0;
#else
    float seen = float(layerCount);
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
#if defined(LAYER_RGB9E5) && !defined(EMPTY_LAYERS) && !defined(MIXED_LAYERS)
        uint bits = texelFetch(layers, ivec3(pixel, layer), 0).r;
        vec3 value = decodeLayer(bits).rgb;
#if BACKGROUND == 1 || BACKGROUND == 2
        if (bits == 0u) value = behind(imagePlane, layer);
#endif
        addCompensated(sum.rgb, compensation.rgb, value * weight);
#else
#if defined(EMPTY_LAYERS)
        vec4 value = vec4(0.0);
#elif defined(MIXED_LAYERS)
        vec4 value = composed(pixel, layer);
#else
        vec4 value = texelFetch(layers, ivec3(pixel, layer), 0);
#endif
#if BACKGROUND == 1 || BACKGROUND == 2
        value.rgb += (1.0 - value.a) * behind(imagePlane, layer);
#elif BACKGROUND == 0
        addCompensated(sum.a, compensation.a, value.a);
#endif
        addCompensated(sum.rgb, compensation.rgb, value.rgb * weight);
#endif
    }
#if BACKGROUND != 0
    sum.a += seen;   // whole numbers: exact
#endif
    sumOut = sum;
    compensationOut = compensation;
}
