// Adds the radiance of a batch (wave) of line samples to each pixel's compensated sum, in the order of the lines. Each
// line has a range of records (ray hits; lens_space/records.glsl).

#include "lens_space/pixel_sum.glsl"

layout(std430, binding = 1) readonly buffer OutputBlock {
    uint counters[6];
    uvec2 ranges[];   // per line: index of the first record, number of records
};

void main() {
    uint pixel = pixelOfThread();
    if (pixel >= pixelCount) return;
    vec4 sum = begins ? vec4(0.0) : sums[2u * pixel];
    vec4 compensation = begins ? vec4(0.0) : sums[2u * pixel + 1u];
    for (uint ray = 0u; ray < rayCount; ++ray) {
        uvec2 range = ranges[ray * pixelCount + pixel];
        for (uint i = range.x; i < range.x + range.y; ++i) addRecord(sum, compensation, records[i]);
    }
    sums[2u * pixel] = sum;
    sums[2u * pixel + 1u] = compensation;
}
