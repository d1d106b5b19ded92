// Divides triangles into small triangles, inside which the circle of confusion is nearly linear (divide.glsl). The
// vertices of the small triangles are computed later (divide_clips.comp, divide_attributes.comp).

#include "lens_space/divide.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 1) readonly buffer BaseBlock { uvec4 bases[]; };
layout(std430, binding = 2) writeonly buffer TriangleBlock { uvec4 triangles[]; };
#ifdef LIGHTS_VERTICES
// per vertex: lowest index of a triangle with this vertex
layout(std430, binding = 3) buffer FirstBlock { uint firstTriangles[]; };
#endif

layout(location = 0) uniform uint firstBase;       // triangles to divide: [firstBase, firstBase + baseCount)
layout(location = 1) uniform uint baseCount;
layout(location = 2) uniform uint parts;
layout(location = 3) uniform uint firstVertex;     // index of the first new vertex among the frame's vertices
layout(location = 4) uniform uint firstTriangle;   // index of the first small triangle among the frame's triangles

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint perBase = parts * parts;
    if (i >= baseCount * perBase) return;
    uint base = i / perBase;
    uint inBase = i % perBase;
    // Row r of a triangle has 2r + 1 small triangles, which alternately point to the first corner and away from it.
    uint row = uint(sqrt(float(inBase)));
    if ((row + 1u) * (row + 1u) <= inBase) ++row;
    if (row * row > inBase) --row;
    uint column = (inBase - row * row) / 2u;
    bool pointsAway = ((inBase - row * row) & 1u) != 0u;
    uvec2 a = uvec2(row, column);
    uvec2 b = a + uvec2(1u, pointsAway ? 1u : 0u);
    uvec2 c = a + uvec2(pointsAway ? 0u : 1u, 1u);
    uvec3 corners = firstVertex + base * verticesPerTriangle(parts) + uvec3(vertexNumber(a), vertexNumber(b), vertexNumber(c));
    triangles[firstTriangle + i] = uvec4(corners, bases[firstBase + base].w);
#ifdef LIGHTS_VERTICES
    for (int corner = 0; corner < 3; ++corner) atomicMin(firstTriangles[corners[corner]], firstTriangle + i);
#endif
}
