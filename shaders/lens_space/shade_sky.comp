// Shades the records of rays that hit no surface with the radiance of the sky. The sky is blurred like a surface at
// infinite depth, whose inverse depth is 0.

#include "lens_space/shade.glsl"

vec4 lightOf(Record record, Ray ray, vec2 lens, vec2 place) {
    if (backgroundType == 0) return vec4(0.0);
    vec2 pinhole = place - shiftThroughLens(0.0, place, vec2(1.0, 0.0), lens);
    if (cocControls || aberrations)
        for (int i = 0; i < 3; ++i) pinhole = place - shiftThroughLens(0.0, pinhole, vec2(1.0, 0.0), lens);
    vec3 direction = normalize(mat3(frame.worldFromView) * vec3(pinhole / frame.projection.xy, -1.0));
    return vec4(skyRadiance(backgroundType, direction), 1.0);
}
