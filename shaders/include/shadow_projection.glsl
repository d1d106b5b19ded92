// Projects directions and positions into shadow maps, for drawing and reading the maps; see src/plan/visible/shadows.h.
// shadowPoints: number of points on each light; shadowMapCount: number of maps that are needed if each light has one
// point.

layout(binding = 30) uniform samplerBuffer shadowProjections;
layout(location = 2) uniform int firstShadowSample;   // index of layer 0's lens sample

int shadowTexel(int layer, int slot) {
    return ((firstShadowSample + layer) * (shadowPoints * shadowMapCount) + slot) * 6;
}

// Returns the change in clip-space coordinates along the vector `direction` (in m, world axes).
vec4 shadowDirection(int texel, vec3 direction) {
    return vec4(dot(texelFetch(shadowProjections, texel).xyz, direction), dot(texelFetch(shadowProjections, texel + 1).xyz, direction),
                dot(texelFetch(shadowProjections, texel + 2).xyz, direction), dot(texelFetch(shadowProjections, texel + 3).xyz, direction));
}

// Returns the clip-space coordinates of the position `place` (relative to the camera, in m, world axes).
vec4 shadowPosition(int texel, vec3 place) {
    vec4 at = vec4(place, 1.0);
    return vec4(dot(texelFetch(shadowProjections, texel), at), dot(texelFetch(shadowProjections, texel + 1), at),
                dot(texelFetch(shadowProjections, texel + 2), at), dot(texelFetch(shadowProjections, texel + 3), at));
}
