// Adds the results of a wave's rays to each pixel's compensated sum, in order.

#include "include/compensated.glsl"
#include "lens_space/records.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) buffer SumBlock { vec4 sums[]; };   // per pixel: the sum and its compensation
#ifdef LINES
layout(std430, binding = 1) readonly buffer OutputBlock {
    uint counters[6];
    uvec2 ranges[];   // per ray: first record, number of records
};
#endif

layout(location = 0) uniform uint pixelCount;
layout(location = 1) uniform uint rayCount;
layout(location = 2) uniform bool begins;   // true: first wave of the frame

void main() {
    uint pixel = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (pixel >= pixelCount) return;
    vec4 sum = begins ? vec4(0.0) : sums[2u * pixel];
    vec4 compensation = begins ? vec4(0.0) : sums[2u * pixel + 1u];
    for (uint ray = 0u; ray < rayCount; ++ray) {
        uint at = ray * pixelCount + pixel;
#ifdef LINES
        uvec2 range = ranges[at];
        for (uint i = range.x; i < range.x + range.y; ++i) {
            Record light = records[i];
#else
            Record light = records[at];
#endif
            addCompensated(sum.rgb, compensation.rgb, vec3(uintBitsToFloat(light.triangle), uintBitsToFloat(light.ray), light.place));
            addCompensated(sum.a, compensation.a, light.weight);
#ifdef LINES
        }
#endif
    }
    sums[2u * pixel] = sum;
    sums[2u * pixel + 1u] = compensation;
}
