// Shades the records of one group: surfaces with the same material and features, or the sky (SKY).

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/environment.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "lens_space/groups.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 4) readonly buffer GroupBlock { Group groups[]; };
layout(std430, binding = 5) readonly buffer ListBlock { uint list[]; };

layout(location = 2) uniform uint group;
layout(location = 3) uniform float lensRadius;   // m

#ifndef SKY
vec3 barycentric(vec3 edges) { return edges / (edges.x + edges.y + edges.z); }

#ifdef VERTEX_LIGHT
layout(std430, binding = 3) readonly buffer LightBlock { vec4 lights[]; };   // per vertex: front, back

// Returns the interpolated light of the triangle's vertices.
vec4 surfaceLight(uvec3 vertices, Ray ray, vec2 lens, vec2 place) {
    float time = ray.values.x;
    vec3 edges = edgeFunctions(clipAt(vertices.x, time), clipAt(vertices.y, time), clipAt(vertices.z, time), lens, place);
    vec3 here = barycentric(edges);
    uvec3 at = 2u * vertices + (edges.x + edges.y + edges.z > 0.0 ? 0u : 1u);
    return here.x * lights[at.x] + here.y * lights[at.y] + here.z * lights[at.z];
}
#else
#include "lens_space/surface.glsl"

vec4 surfaceLight(uvec3 vertices, Ray ray, vec2 lens, vec2 place) {
    float time = ray.values.x;
    vec4 a = clipAt(vertices.x, time);
    vec4 b = clipAt(vertices.y, time);
    vec4 c = clipAt(vertices.z, time);
    vec3 edges = edgeFunctions(a, b, c, lens, place);
    vec2 pixel = 2.0 / vec2(imageSize);
    vec3 here = barycentric(edges);
    vec3 right = barycentric(edgeFunctions(a, b, c, lens, place + vec2(pixel.x, 0.0)));
    vec3 up = barycentric(edgeFunctions(a, b, c, lens, place + vec2(0.0, pixel.y)));
    Attributes p = attributes[vertices.x];
    Attributes q = attributes[vertices.y];
    Attributes r = attributes[vertices.z];
    surface.color = material.baseColor * (here.x * p.color + here.y * q.color + here.z * r.color);
    surface.uv = here.x * p.uv + here.y * q.uv + here.z * r.uv;
    surface.uvRight = right.x * p.uv + right.y * q.uv + right.z * r.uv;
    surface.uvUp = up.x * p.uv + up.y * q.uv + up.z * r.uv;
    surface.showsFront = edges.x + edges.y + edges.z > 0.0;
    vec4 normal = here.x * p.normal + here.y * q.normal + here.z * r.normal;
    surface.normal = normal.xyz;
    surface.agreement = normal.w;
    surface.normalRight = right.x * p.normal.xyz + right.y * q.normal.xyz + right.z * r.normal.xyz;
    surface.normalUp = up.x * p.normal.xyz + up.y * q.normal.xyz + up.z * r.normal.xyz;
    surface.tangent = here.x * p.tangent + here.y * q.tangent + here.z * r.tangent;
    surface.position = here.x * p.position.xyz + here.y * q.position.xyz + here.z * r.position.xyz;
    vec2 eye = lensRadius * vec2(lens.x, lens.y * float(imageSize.y) / float(imageSize.x));
    surface.toEye = mat3(frame.worldFromView) * vec3(eye, 0.0) - surface.position;
    return vec4(surfaceRadiance(texturedColor(surface.color).rgb), 1.0);
}
#endif
#else

// Returns the sky's radiance. The sky lies at infinity, where C/w = b.
vec4 sky(vec2 lens, vec2 place) {
#if BACKGROUND == 0
    return vec4(0.0);
#else
    vec2 pinhole = place - relativeCircleOfConfusion(0.0, place, vec2(1.0, 0.0)) * lens;
#ifdef COC_CONTROLS
    for (int i = 0; i < 3; ++i) pinhole = place - relativeCircleOfConfusion(0.0, pinhole, vec2(1.0, 0.0)) * lens;
#endif
    vec3 direction = normalize(mat3(frame.worldFromView) * vec3(pinhole / frame.projection.xy, -1.0));
#if BACKGROUND == 3
    return vec4(environmentRadiance(direction, 0.0), 1.0);
#elif BACKGROUND == 2
    return vec4(gradientRadiance(direction.y), 1.0);
#else
    return vec4(lighting.environment[0].rgb, 1.0);
#endif
#endif
}
#endif

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= groups[group].count) return;
    uint at = list[groups[group].first + index];
    Record record = records[at];
    uint pixelCount = uint(imageSize.x * imageSize.y);
    uint inImage = record.ray % pixelCount;
    uvec2 pixel = uvec2(inImage % uint(imageSize.x), inImage / uint(imageSize.x));
    Ray ray = rayOf(record.ray / pixelCount, pixel);
    vec2 place = placeOf(ray, pixel);
#ifdef LINES
    vec2 lens = record.place * ray.lensAndPixel.xy;
#else
    vec2 lens = ray.lensAndPixel.xy;
#endif
#ifdef SKY
    vec4 light = sky(lens, place);
#else
    vec4 light = surfaceLight(triangles[record.triangle].xyz, ray, lens, place);
#endif
    light *= record.weight;
    records[at] = Record(floatBitsToUint(light.r), floatBitsToUint(light.g), light.b, light.a);
}
