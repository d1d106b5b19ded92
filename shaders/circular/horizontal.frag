// Filters the rows of a field (premultiplied radiance and its weight) with COMPONENTS complex kernels. The result is
// divided by the number of taps. The sum of the taps is no suitable divisor, because it nearly vanishes at some radii.
#include "include/complex_kernel.glsl"

layout(binding = 0) uniform sampler2D field;
layout(binding = 1) uniform sampler2D radii;
#if BRACKETED
layout(binding = 2) uniform sampler2D brightest;       // one pixel: the field's max radiance and max weight
layout(location = 16) uniform vec4 brackets[COMPONENTS];   // offset and scale, real part then imaginary
#endif
layout(location = 15) uniform int firstComponent;

#if BRACKETED
// Per component: real rgb, imaginary rgb, and (real, imaginary) of the weight with the weight's mean. The last output
// is the mean rgb.
layout(location = 0) out vec4 sums[3 * COMPONENTS + 1];
#else
layout(location = 0) out vec4 sums[2 * COMPONENTS];    // real, imaginary
#endif

vec4 pairAt(ivec2 pixel, int i, Taps taps) {
#if TAPS_EXACT
    int last = textureSize(field, 0).x - 1;
    return texelFetch(field, ivec2(max(pixel.x - i, 0), pixel.y), 0) +
           texelFetch(field, ivec2(min(pixel.x + i, last), pixel.y), 0);
#else
    vec2 perPixel = 1.0 / vec2(textureSize(field, 0));
    vec2 centre = (vec2(pixel) + 0.5) * perPixel;
    vec2 offset = vec2(float(i) * taps.spacing * perPixel.x, 0.0);
    return textureLod(field, centre - offset, 0.0) + textureLod(field, centre + offset, 0.0);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Taps taps = tapsOf(AXES.x * texelFetch(radii, pixel, 0).r);
    vec4 middle = texelFetch(field, pixel, 0);
    vec2 f[COMPONENTS];
    vec2 ratio[COMPONENTS];
    vec2 grow[COMPONENTS];
    vec4 real[COMPONENTS];
    vec4 imaginary[COMPONENTS];
    for (int c = 0; c < COMPONENTS; ++c) {
        ratio[c] = firstRatio(kernel[firstComponent + c], taps);
        grow[c] = times(ratio[c], ratio[c]);
        f[c] = vec2(1.0, 0.0);
        real[c] = middle;
        imaginary[c] = vec4(0.0);
    }
#if BRACKETED
    vec4 plain = middle;
#endif
    for (int i = 1; i <= taps.count; ++i) {
        float part = fade(taps, i);
        vec4 pair = part * pairAt(pixel, i, taps);
#if BRACKETED
        plain += pair;
#endif
        for (int c = 0; c < COMPONENTS; ++c) {
            f[c] = times(f[c], ratio[c]);
            ratio[c] = times(ratio[c], grow[c]);
            real[c] += f[c].x * pair;
            imaginary[c] += f[c].y * pair;
        }
    }
    float perTap = 1.0 / tapCount(taps);
#if BRACKETED
    vec4 exposure = 1.0 / max(texelFetch(brightest, ivec2(0), 0).rrrg, 1e-30);
    vec4 mean = plain * exposure * perTap;
    sums[3 * COMPONENTS] = vec4(mean.rgb, 0.0);
    for (int c = 0; c < COMPONENTS; ++c) {
        vec4 re = (real[c] * exposure * perTap - brackets[c].x * mean) / brackets[c].y;
        vec4 im = (imaginary[c] * exposure * perTap - brackets[c].z * mean) / brackets[c].w;
        sums[3 * c] = vec4(re.rgb, 0.0);
        sums[3 * c + 1] = vec4(im.rgb, 0.0);
        sums[3 * c + 2] = vec4(re.a, im.a, mean.a, 0.0);
    }
#else
    for (int c = 0; c < COMPONENTS; ++c) {
        sums[2 * c] = clamp(real[c] * perTap, -LARGEST, LARGEST);
        sums[2 * c + 1] = clamp(imaginary[c] * perTap, -LARGEST, LARGEST);
    }
#endif
}
