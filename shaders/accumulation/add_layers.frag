// Composes each of the wave's layers over the environment and adds them, one after the other in order, to the compensated sum of
// the block.
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
layout(location = 0) uniform int layerCount;
layout(location = 1) uniform int firstInBlock;

layout(location = 0) out vec4 sumOut;
layout(location = 1) out vec4 compensationOut;

#if BACKGROUND == 2
// The sky that a sample sees through this pixel.
vec3 behind(vec2 imagePlane, int layer) {
#ifdef COC_CONTROLS
    float blur = relativeCircleOfConfusion(0.0, imagePlane * frame.projection.xy, 1.0);
    vec2 p = imagePlane + blur * sampleShifts[firstInBlock + layer].xy + sampleShifts[firstInBlock + layer].zw;
#else
    vec2 p = imagePlane + sampleShifts[firstInBlock + layer].xy;
#endif
    vec3 up = vec3(frame.worldFromView[0].y, frame.worldFromView[1].y, frame.worldFromView[2].y);
    return gradientRadiance((dot(up.xy, p) - up.z) * inversesqrt(dot(p, p) + 1.0));
}
#elif BACKGROUND == 1
vec3 behind(vec2 imagePlane, int layer) { return frame.environment[0].rgb; }
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool startsBlock = firstInBlock == 0;
    vec4 sum = startsBlock ? vec4(0.0) : texelFetch(sumSoFar, pixel, 0);
    vec4 compensation = startsBlock ? vec4(0.0) : texelFetch(compensationSoFar, pixel, 0);
    vec2 imagePlane = (2.0 * gl_FragCoord.xy / vec2(textureSize(layers, 0).xy) - 1.0) / frame.projection.xy;
    for (int layer = 0; layer < layerCount; ++layer) {
#ifdef LAYER_RGB9E5
        uint bits = texelFetch(layers, ivec3(pixel, layer), 0).r;
        vec3 value = decodeLayer(bits).rgb;
#if BACKGROUND == 1 || BACKGROUND == 2
        if (bits == 0u) value = behind(imagePlane, layer);
#endif
        addCompensated(sum.rgb, compensation.rgb, value);
#else
        vec4 value = texelFetch(layers, ivec3(pixel, layer), 0);
#if BACKGROUND == 1 || BACKGROUND == 2
        value.rgb += (1.0 - value.a) * behind(imagePlane, layer);
#elif BACKGROUND == 0
        addCompensated(sum.a, compensation.a, value.a);
#endif
        addCompensated(sum.rgb, compensation.rgb, value.rgb);
#endif
    }
#if BACKGROUND != 0
    sum.a += float(layerCount);   // whole numbers: exact
#endif
    sumOut = sum;
    compensationOut = compensation;
}
