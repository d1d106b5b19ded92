// Second part of kernel 1 of the lens-space methods, the kernel that prepares vertices and triangles: converts a range
// of the vertex indices of a level of detail to triangles of the frame. A triangle is counter-clockwise in the image if
// its front is visible.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer IndexBlock { uint indices[]; };
layout(std430, binding = 2) writeonly buffer TriangleBlock { uvec4 triangles[]; };
#ifdef LIGHTS_VERTICES
// per vertex: lowest index of a triangle with this vertex
layout(std430, binding = 3) buffer FirstBlock { uint firstTriangles[]; };
#endif

layout(location = 0) uniform uint firstIndex;
layout(location = 1) uniform uint triangleCount;
layout(location = 2) uniform uint firstVertex;     // index of the level's first vertex among the frame's vertices
layout(location = 3) uniform uint firstTriangle;   // index in `triangles` of the first triangle to write
layout(location = 4) uniform uint draw;
layout(location = 5) uniform bool mirrored;

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= triangleCount) return;
    uint at = firstIndex + 3u * i;
    uvec3 corners = uvec3(indices[at], indices[at + 1u], indices[at + 2u]) + firstVertex;
    if (mirrored) corners.yz = corners.zy;
    triangles[firstTriangle + i] = uvec4(corners, draw);
#ifdef LIGHTS_VERTICES
    for (int corner = 0; corner < 3; ++corner) atomicMin(firstTriangles[corners[corner]], firstTriangle + i);
#endif
}
