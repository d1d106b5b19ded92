// The same kernel as the separable passes, gathered over its whole square: what they are checked and timed against.
#include "include/complex_kernel.glsl"

layout(binding = 0) uniform sampler2D field;
layout(binding = 1) uniform sampler2D radii;

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(field, 0) - 1;
    Taps taps = tapsOf(texelFetch(radii, pixel, 0).r);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -taps.count; y <= taps.count; ++y)
        for (int x = -taps.count; x <= taps.count; ++x) {
            float u = float(x * x + y * y) / (taps.radius * taps.radius);
            float value = 0.0;
            for (int c = 0; c < KERNEL_SIZE; ++c)
                value += exp(-kernel[c].x * u) * (kernel[c].z * cos(kernel[c].y * u) + kernel[c].w * sin(kernel[c].y * u));
            value *= fade(taps, abs(x)) * fade(taps, abs(y));
#if TAPS_EXACT
            sum += value * texelFetch(field, clamp(pixel + ivec2(x, y), ivec2(0), last), 0);
#else
            vec2 place = vec2(pixel) + 0.5 + taps.spacing * vec2(x, y);
            sum += value * textureLod(field, place / vec2(textureSize(field, 0)), 0.0);
#endif
            weights += value;
        }
    blurred = sum / weights;
}
