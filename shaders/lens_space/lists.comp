// Sorts records (ray hits) by the shader of the surface: surfaces with the same shader form a group. With countsOnly,
// counts each group's records; otherwise writes the records' indices to the groups' ranges of the list.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/records.glsl"
#include "lens_space/groups.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 3) readonly buffer DrawBlock { Draw draws[]; };
layout(std430, binding = 4) buffer GroupBlock { Group groups[]; };   // one group per shader; group 0: the sky
layout(std430, binding = 5) writeonly buffer ListBlock { uint list[]; };

layout(location = 0) uniform uint recordCount;

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= recordCount) return;
    uint triangle = records[index].triangle;
    uint group = triangle == noTriangle ? 0u : draws[triangles[triangle].w].group;
    if (countsOnly)
        atomicAdd(groups[group].count, 1u);
    else
        list[groups[group].first + atomicAdd(groups[group].listed, 1u)] = index;
}
