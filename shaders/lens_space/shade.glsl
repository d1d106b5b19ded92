// Shades the records (ray hits) of one group: all surfaces that use the same shader, or the sky. Each file that
// includes this one defines lightOf().

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/environment.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "lens_space/record_rays.glsl"
#include "lens_space/groups.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 4) readonly buffer GroupBlock { Group groups[]; };
layout(std430, binding = 5) readonly buffer ListBlock { uint list[]; };

layout(location = 2) uniform uint group;
layout(location = 3) uniform float lensRadius;   // m

// Returns the radiance (rgb) and coverage of a record's surface, or of the sky, along the ray through lens point `lens`
// to image position `place`.
vec4 lightOf(Record record, Ray ray, vec2 lens, vec2 place);

vec3 barycentric(vec3 edges) { return edges / (edges.x + edges.y + edges.z); }

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= groups[group].count) return;
    uint at = list[groups[group].first + index];
    Record record = records[at];
    uvec2 pixel = pixelOf(record);
    Ray ray = rayOf(numberOf(record), pixel);
    vec2 place = placeOf(ray, pixel);
    vec2 lens = lensPointOf(record, ray);
    vec4 light = lightOf(record, ray, lens, place) * record.weight;
    records[at] = Record(floatBitsToUint(light.r), floatBitsToUint(light.g), light.b, light.a);
}
