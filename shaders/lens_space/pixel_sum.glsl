// Compensated sum of the results of each pixel's rays.

#include "include/compensated.glsl"
#include "lens_space/records.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) buffer SumBlock { vec4 sums[]; };   // per pixel: the sum and its compensation

layout(location = 0) uniform uint pixelCount;
layout(location = 1) uniform uint rayCount;
layout(location = 2) uniform bool begins;   // true: first wave of the frame

// Returns the pixel of this thread; pixelCount and above: none.
uint pixelOfThread() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// Adds a shaded record.
void addRecord(inout vec4 sum, inout vec4 compensation, Record light) {
    addCompensated(sum.rgb, compensation.rgb, vec3(uintBitsToFloat(light.triangle), uintBitsToFloat(light.ray), light.place));
    addCompensated(sum.a, compensation.a, light.weight);
}
