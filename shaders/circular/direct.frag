// Blurs the near or far field with the kernel of the separable passes as one direct 2D sum, a reference for tests and
// timings.
#include "include/complex_kernel.glsl"

layout(binding = 0) uniform sampler2D field;
layout(binding = 1) uniform sampler2D radii;

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(field, 0) - 1;
    float radius = texelFetch(radii, pixel, 0).r;
    Taps columns = tapsOf(kernelAxes.x * radius);
    Taps rows = tapsOf(kernelAxes.y * radius);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -rows.count; y <= rows.count; ++y)
        for (int x = -columns.count; x <= columns.count; ++x) {
            vec2 inRadii = vec2(float(x) / columns.radius, float(y) / rows.radius);
            float u = dot(inRadii, inRadii);
            float value = 0.0;
            for (int c = 0; c < kernelSize; ++c)
                value += exp(-kernel[c].x * u) * (kernel[c].z * cos(kernel[c].y * u) + kernel[c].w * sin(kernel[c].y * u));
            value *= fade(columns, abs(x)) * fade(rows, abs(y));
            vec2 place = vec2(pixel) + 0.5 + vec2(columns.spacing, rows.spacing) * vec2(x, y);
            if (exactTaps)
                sum += value * texelFetch(field, clamp(pixel + ivec2(x, y), ivec2(0), last), 0);
            else
                sum += value * textureLod(field, place / vec2(textureSize(field, 0)), 0.0);
            weights += value;
        }
    blurred = sum / weights;
}
