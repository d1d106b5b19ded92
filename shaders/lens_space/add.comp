// Adds the radiance of a batch (wave) of rays to each pixel's compensated sum, in the order of the rays. Each ray has
// one record, which holds its hit (records.glsl).

#include "lens_space/pixel_sum.glsl"

void main() {
    uint pixel = pixelOfThread();
    if (pixel >= pixelCount) return;
    vec4 sum = begins ? vec4(0.0) : sums[2u * pixel];
    vec4 compensation = begins ? vec4(0.0) : sums[2u * pixel + 1u];
    for (uint ray = 0u; ray < rayCount; ++ray) addRecord(sum, compensation, records[ray * pixelCount + pixel]);
    sums[2u * pixel] = sum;
    sums[2u * pixel + 1u] = compensation;
}
