// Computes the vertices of divided triangles (divide.glsl) at one time within the exposure. Positions and blur
// modifiers are interpolated, and the circle of confusion is evaluated at each vertex.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "lens_space/clip_blur.glsl"
#include "lens_space/divide.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 0) buffer ClipBlock { vec4 clips[]; };
layout(std430, binding = 1) readonly buffer BaseBlock { uvec4 bases[]; };
layout(std430, binding = 2) readonly buffer OwnBlock { vec2 ownBlurs[]; };   // per vertex: blur modifiers (lens.glsl)

layout(location = 0) uniform uint firstBase;     // triangles to divide: [firstBase, firstBase + baseCount)
layout(location = 1) uniform uint baseCount;
layout(location = 2) uniform uint parts;
layout(location = 3) uniform uint firstVertex;   // index of the first new vertex among the frame's vertices

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint perBase = verticesPerTriangle(parts);
    if (i >= baseCount * perBase) return;
    uvec3 corners = bases[firstBase + i / perBase].xyz;
    vec3 weights = weightsOf(i % perBase, parts);
    precise vec3 pinhole = weights.x * clips[corners.x].xyz + weights.y * clips[corners.y].xyz + weights.z * clips[corners.z].xyz;
    precise vec2 own = weights.x * ownBlurs[corners.x] + weights.y * ownBlurs[corners.y] + weights.z * ownBlurs[corners.z];
    clips[firstVertex + i] = vec4(pinhole, clipBlur(pinhole, own));
}
