// Shades the records (ray hits) of surfaces with the same material and features.

#include "lens_space/shade.glsl"
#include "lens_space/surface.glsl"
#include "lens_space/hit.glsl"

vec4 lightOf(Record record, Ray ray, vec2 lens, vec2 place) {
    readHit(record.triangle, ray.values.x, lens, place);
    vec2 eye = lensRadius * vec2(lens.x, lens.y * float(imageSize.y) / float(imageSize.x));
    surface.toEye = mat3(frame.worldFromView) * vec3(eye, 0.0) - surface.position;
    return vec4(surfaceRadiance(texturedColor(surface.color).rgb), 1.0);
}
