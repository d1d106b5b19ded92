// Filters the rows of the near or far field (premultiplied radiance and its weight) with `components` complex kernels.
// The result is divided by the number of taps, not by the sum of the complex taps, which nearly vanishes at some radii.
#include "include/complex_kernel.glsl"

layout(binding = 0) uniform sampler2D field;
layout(binding = 1) uniform sampler2D radii;
// Max radiance (red) and max weight (green) of the near or far field. Read only with `bracketed`, that is, if the sums
// are mapped to [0, 1] for storage in ten bits.
layout(binding = 2) uniform sampler2D brightest;
// per component: offset and scale of the real part for the mapping to [0, 1], then of the imaginary part
layout(location = 16) uniform vec4 brackets[components];
layout(location = 15) uniform int firstComponent;

// Two outputs per component: the real part and the imaginary part of the sum. If `bracketed` (sums mapped to [0, 1];
// Bracket in src/render/circular/complex_blur.h), three outputs per component: the real part of rgb, the imaginary part
// of rgb, and (real part, imaginary part, mean) of the field's alpha. One more output holds the mean of rgb. Means are
// over the taps, without the kernel.
layout(location = 0) out vec4 sums[bracketed ? 3 * components + 1 : 2 * components];

vec4 pairAt(ivec2 pixel, int i, Taps taps) {
    int last = textureSize(field, 0).x - 1;
    if (exactTaps)
        return texelFetch(field, ivec2(max(pixel.x - i, 0), pixel.y), 0) +
               texelFetch(field, ivec2(min(pixel.x + i, last), pixel.y), 0);
    vec2 perPixel = 1.0 / vec2(textureSize(field, 0));
    vec2 centre = (vec2(pixel) + 0.5) * perPixel;
    vec2 offset = vec2(float(i) * taps.spacing * perPixel.x, 0.0);
    return textureLod(field, centre - offset, 0.0) + textureLod(field, centre + offset, 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Taps taps = tapsOf(kernelAxes.x * texelFetch(radii, pixel, 0).r);
    vec4 middle = texelFetch(field, pixel, 0);
    vec2 f[components];
    vec2 ratio[components];
    vec2 grow[components];
    vec4 real[components];
    vec4 imaginary[components];
    for (int c = 0; c < components; ++c) {
        ratio[c] = firstRatio(kernel[firstComponent + c], taps);
        grow[c] = times(ratio[c], ratio[c]);
        f[c] = vec2(1.0, 0.0);
        real[c] = middle;
        imaginary[c] = vec4(0.0);
    }
    vec4 plain = middle;
    for (int i = 1; i <= taps.count; ++i) {
        float part = fade(taps, i);
        vec4 pair = part * pairAt(pixel, i, taps);
        plain += pair;
        for (int c = 0; c < components; ++c) {
            f[c] = times(f[c], ratio[c]);
            ratio[c] = times(ratio[c], grow[c]);
            real[c] += f[c].x * pair;
            imaginary[c] += f[c].y * pair;
        }
    }
    float perTap = 1.0 / tapCount(taps);
    if (!bracketed) {
        for (int c = 0; c < components; ++c) {
            sums[2 * c] = clamp(real[c] * perTap, -largestSum, largestSum);
            sums[2 * c + 1] = clamp(imaginary[c] * perTap, -largestSum, largestSum);
        }
        return;
    }
    vec4 exposure = 1.0 / max(texelFetch(brightest, ivec2(0), 0).rrrg, 1e-30);
    vec4 mean = plain * exposure * perTap;
    sums[sums.length() - 1] = vec4(mean.rgb, 0.0);
    for (int c = 0; c < components; ++c) {
        vec4 re = (real[c] * exposure * perTap - brackets[c].x * mean) / brackets[c].y;
        vec4 im = (imaginary[c] * exposure * perTap - brackets[c].z * mean) / brackets[c].w;
        sums[3 * c] = vec4(re.rgb, 0.0);
        sums[3 * c + 1] = vec4(im.rgb, 0.0);
        sums[3 * c + 2] = vec4(re.a, im.a, mean.a, 0.0);
    }
}
