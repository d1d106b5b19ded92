// Adds the radiance of rays to the compensated sum of each pixel.

#include "include/compensated.glsl"
#include "lens_space/records.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) buffer SumBlock { vec4 sums[]; };   // per pixel: sum of radiance, then its rounding error

layout(location = 0) uniform uint pixelCount;
layout(location = 1) uniform uint rayCount;
layout(location = 2) uniform bool begins;   // true: first batch (wave) of rays of the frame

// Returns the index of this thread's pixel. Threads with an index ≥ pixelCount have no pixel.
uint pixelOfThread() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// Adds the radiance of a shaded record (ray hit) to a pixel's sum. Shading has replaced the hit by its radiance
// (records.glsl).
void addRecord(inout vec4 sum, inout vec4 compensation, Record light) {
    addCompensated(sum.rgb, compensation.rgb, vec3(uintBitsToFloat(light.triangle), uintBitsToFloat(light.ray), light.place));
    addCompensated(sum.a, compensation.a, light.weight);
}
