// Third part of kernel 1 of the lens-space methods, the kernel that prepares vertices and triangles: shades both sides
// of the surface at each vertex, as seen from the lens centre. One dispatch shades surfaces with the same material and
// features. The radiance is interpolated between vertices, so texture lookups and highlights are filtered over an area
// around the vertex. This area extends halfway to the other two corners of the frame's first triangle that has this
// vertex.

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/environment.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/surface.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 4) readonly buffer DrawBlock { Draw draws[]; };
// two entries per vertex: radiance of the front, then radiance of the back
layout(std430, binding = 5) writeonly buffer LightBlock { vec4 lights[]; };
// per vertex: lowest index of a triangle with this vertex, or noTriangle
layout(std430, binding = 6) readonly buffer FirstBlock { uint firstTriangles[]; };

layout(location = 0) uniform uint vertexCount;
layout(location = 1) uniform uint group;

void main() {
    uint vertex = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (vertex >= vertexCount) return;
    uint first = firstTriangles[vertex];
    if (first == noTriangle) return;
    uvec4 triangle = triangles[first];
    if (draws[triangle.w].group != group) return;
    uvec3 corners = triangle.xyz;
    while (corners.x != vertex) corners = corners.yzx;
    Attributes here = attributes[corners.x];
    Attributes right = attributes[corners.y];
    Attributes up = attributes[corners.z];
    surface.color = material.baseColor * here.color;
    surface.uv = here.uv;
    surface.uvRight = mix(here.uv, right.uv, 0.5);
    surface.uvUp = mix(here.uv, up.uv, 0.5);
    surface.normal = here.normal.xyz;
    surface.agreement = here.normal.w;
    surface.normalRight = mix(here.normal.xyz, right.normal.xyz, 0.5);
    surface.normalUp = mix(here.normal.xyz, up.normal.xyz, 0.5);
    surface.tangent = here.tangent;
    surface.position = here.position.xyz;
    surface.toEye = -here.position.xyz;
    vec3 color = texturedColor(surface.color).rgb;
    surface.showsFront = true;
    lights[2u * vertex] = vec4(surfaceRadiance(color), 1.0);
    surface.showsFront = false;
    lights[2u * vertex + 1u] = vec4(surfaceRadiance(color), 1.0);
}
