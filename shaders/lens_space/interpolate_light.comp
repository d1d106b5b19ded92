// Shades records (ray hits) by interpolating the radiance of the hit triangle's vertices.

#include "lens_space/shade.glsl"

// per vertex: radiance of the front, radiance of the back
layout(std430, binding = 3) readonly buffer LightBlock { vec4 lights[]; };

vec4 lightOf(Record record, Ray ray, vec2 lens, vec2 place) {
    uvec3 vertices = triangles[record.triangle].xyz;
    float time = ray.values.x;
    vec3 edges = edgeFunctions(clipAt(vertices.x, time), clipAt(vertices.y, time), clipAt(vertices.z, time), lens, place);
    vec3 here = barycentric(edges);
    uvec3 at = 2u * vertices + (edges.x + edges.y + edges.z > 0.0 ? 0u : 1u);
    return here.x * lights[at.x] + here.y * lights[at.y] + here.z * lights[at.z];
}
