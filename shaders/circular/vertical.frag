// Filters the columns of the complex row sums from horizontal.frag and adds the components. The output is the blurred
// near or far field, divided by the sum of the kernel over all taps. If the radii of the rows differ from this pixel's
// radius, this sum is inexact, but the ratio of radiance to weight stays correct. kernelAxes: horizontal and vertical
// semi-axis of an elliptical blur, relative to the disk's radius.
#include "include/complex_kernel.glsl"

// Input: the sum along each row, as written by horizontal.frag.
layout(binding = 0) uniform sampler2D sums[bracketed ? 3 * components + 1 : 2 * components];
layout(binding = 9) uniform sampler2D brightest;
layout(location = 16) uniform vec4 brackets[components];
layout(binding = 8) uniform sampler2D radii;
layout(location = 15) uniform int firstComponent;

layout(location = 0) out vec4 blurred;

struct Complex4 {
    vec4 re;
    vec4 im;
};

vec4 sumAt(int i, ivec2 pixel, float offset) {
    if (exactTaps) return texelFetch(sums[i], ivec2(pixel.x, clamp(pixel.y + int(offset), 0, textureSize(sums[i], 0).y - 1)), 0);
    return textureLod(sums[i], (vec2(pixel) + vec2(0.5, 0.5 + offset)) / vec2(textureSize(sums[i], 0)), 0.0);
}

Complex4 rowSum(int c, ivec2 pixel, float offset) {
    if (!bracketed) return Complex4(sumAt(2 * c, pixel, offset), sumAt(2 * c + 1, pixel, offset));
    vec4 weight = sumAt(3 * c + 2, pixel, offset);
    vec4 mean = vec4(sumAt(sums.length() - 1, pixel, offset).rgb, weight.b);
    vec4 re = vec4(sumAt(3 * c, pixel, offset).rgb, weight.r);
    vec4 im = vec4(sumAt(3 * c + 1, pixel, offset).rgb, weight.g);
    vec4 k = brackets[c];
    return Complex4(k.y * re + k.x * mean, k.w * im + k.z * mean);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float radius = texelFetch(radii, pixel, 0).r;
    const bool isOval = kernelAxes.x != kernelAxes.y;
    Taps taps = tapsOf(kernelAxes.y * radius);
    Taps rowTaps = tapsOf(kernelAxes.x * radius);
    vec4 sum = vec4(0.0);
    float kernelSum = 0.0;
    for (int c = 0; c < components; ++c) {
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
        vec2 rowNorm = isOval ? tapSum(component, rowTaps) : norm;
        kernelSum += times(times(weight, rowNorm), norm).x;
    }
    if (components < kernelSize) {
        // If this pass filters only some of the kernel's components, kernelSum must still include all of them.
        kernelSum = 0.0;
        for (int c = 0; c < kernelSize; ++c) {
            vec2 norm = tapSum(kernel[c], taps);
            vec2 rowNorm = isOval ? tapSum(kernel[c], rowTaps) : norm;
            kernelSum += times(times(weightOf(kernel[c]), rowNorm), norm).x;
        }
    }
    // horizontal.frag divides by the number of taps; the factor tapCount() undoes this.
    blurred = sum * (tapCount(rowTaps) / kernelSum);
    if (bracketed) blurred *= texelFetch(brightest, ivec2(0), 0).rrrg;
}
