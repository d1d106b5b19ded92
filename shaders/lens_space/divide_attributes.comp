// Interpolates the attributes of the vertices of divided triangles (divide.glsl).

#include "lens_space/divide.glsl"

struct Attributes {   // attributes of a vertex, in the same layout as in surface.glsl
    vec4 position;
    vec4 normal;
    vec4 color;
    vec4 uv;
    vec4 tangent;
};

layout(local_size_x = 256) in;

layout(std430, binding = 1) readonly buffer BaseBlock { uvec4 bases[]; };
layout(std430, binding = 3) buffer AttributeBlock { Attributes attributes[]; };

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
    Attributes a = attributes[corners.x];
    Attributes b = attributes[corners.y];
    Attributes c = attributes[corners.z];
    attributes[firstVertex + i] =
        Attributes(weights.x * a.position + weights.y * b.position + weights.z * c.position,
                   weights.x * a.normal + weights.y * b.normal + weights.z * c.normal,
                   weights.x * a.color + weights.y * b.color + weights.z * c.color, weights.x * a.uv + weights.y * b.uv + weights.z * c.uv,
                   weights.x * a.tangent + weights.y * b.tangent + weights.z * c.tangent);
}
