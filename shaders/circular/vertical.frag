// Filters the columns of the complex row sums and adds the components. The output is the blurred field, normalised by
// the sum of its taps. If the rows used other radii, that sum is inexact, but the ratio of radiance to weight stays
// correct. AXES: horizontal and vertical radii of an oval, relative to the disk's radius; OVAL: they differ.
#include "include/complex_kernel.glsl"

#if BRACKETED
layout(binding = 0) uniform sampler2D sums[3 * COMPONENTS + 1];
layout(binding = 9) uniform sampler2D brightest;
layout(location = 16) uniform vec4 brackets[COMPONENTS];   // as in horizontal.frag
#else
layout(binding = 0) uniform sampler2D sums[2 * COMPONENTS];
#endif
layout(binding = 8) uniform sampler2D radii;
layout(location = 15) uniform int firstComponent;

layout(location = 0) out vec4 blurred;

struct Complex4 {
    vec4 re;
    vec4 im;
};

#if TAPS_EXACT
#define TEXEL(s) texelFetch(s, ivec2(pixel.x, clamp(pixel.y + int(offset), 0, textureSize(s, 0).y - 1)), 0)
#else
#define TEXEL(s) textureLod(s, (vec2(pixel) + vec2(0.5, 0.5 + offset)) / vec2(textureSize(s, 0)), 0.0)
#endif

Complex4 rowSum(int c, ivec2 pixel, float offset) {
#if BRACKETED
    vec4 weight = TEXEL(sums[3 * c + 2]);
    vec4 mean = vec4(TEXEL(sums[3 * COMPONENTS]).rgb, weight.b);
    vec4 re = vec4(TEXEL(sums[3 * c]).rgb, weight.r);
    vec4 im = vec4(TEXEL(sums[3 * c + 1]).rgb, weight.g);
    vec4 k = brackets[c];
    return Complex4(k.y * re + k.x * mean, k.w * im + k.z * mean);
#else
    return Complex4(TEXEL(sums[2 * c]), TEXEL(sums[2 * c + 1]));
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float radius = texelFetch(radii, pixel, 0).r;
    Taps taps = tapsOf(AXES.y * radius);
    Taps rowTaps = tapsOf(AXES.x * radius);
    vec4 sum = vec4(0.0);
    float kernelSum = 0.0;
    for (int c = 0; c < COMPONENTS; ++c) {
        vec4 component = kernel[firstComponent + c];
        vec2 ratio = firstRatio(component, taps);
        vec2 grow = times(ratio, ratio);
        vec2 f = vec2(1.0, 0.0);
        vec2 norm = f;
        Complex4 middle = rowSum(c, pixel, 0.0);
        vec4 re = middle.re;
        vec4 im = middle.im;
        for (int i = 1; i <= taps.count; ++i) {
            f = times(f, ratio);
            ratio = times(ratio, grow);
            vec2 g = fade(taps, i) * f;
            Complex4 above = rowSum(c, pixel, float(i) * taps.spacing);
            Complex4 below = rowSum(c, pixel, -float(i) * taps.spacing);
            vec4 pairRe = above.re + below.re;
            vec4 pairIm = above.im + below.im;
            re += g.x * pairRe - g.y * pairIm;
            im += g.x * pairIm + g.y * pairRe;
            norm += 2.0 * g;
        }
        vec2 weight = weightOf(component);
        sum += weight.x * re - weight.y * im;
#if OVAL
        vec2 rowNorm = tapSum(component, rowTaps);
#else
        vec2 rowNorm = norm;
#endif
        kernelSum += times(times(weight, rowNorm), norm).x;
    }
#if COMPONENTS < KERNEL_SIZE
    // Other runs of this pass filter the remaining components.
    kernelSum = 0.0;
    for (int c = 0; c < KERNEL_SIZE; ++c) {
        vec2 norm = tapSum(kernel[c], taps);
#if OVAL
        vec2 rowNorm = tapSum(kernel[c], rowTaps);
#else
        vec2 rowNorm = norm;
#endif
        kernelSum += times(times(weightOf(kernel[c]), rowNorm), norm).x;
    }
#endif
    blurred = sum * (tapCount(rowTaps) / kernelSum);   // the rows were divided by their number of taps
#if BRACKETED
    blurred *= texelFetch(brightest, ivec2(0), 0).rrrg;
#endif
}
