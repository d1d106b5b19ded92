// Projection of shadow maps, for drawing and reading; see src/plan/visible/shadows.h. shadowMapCount: number of maps
// with one point per light; shadowPoints: number of points.

layout(binding = 24) uniform samplerBuffer shadowProjections;
layout(location = 2) uniform int firstShadowSample;   // shadow sample of layer 0 in this draw

int shadowTexel(int layer, int slot) {
    return ((firstShadowSample + layer) * (shadowPoints * shadowMapCount) + slot) * 6;
}

// Returns the clip-space coordinates of a direction, in m along the world's axes.
vec4 shadowDirection(int texel, vec3 direction) {
    return vec4(dot(texelFetch(shadowProjections, texel).xyz, direction), dot(texelFetch(shadowProjections, texel + 1).xyz, direction),
                dot(texelFetch(shadowProjections, texel + 2).xyz, direction), dot(texelFetch(shadowProjections, texel + 3).xyz, direction));
}

// Returns the clip-space coordinates of a position, in m from the camera along the world's axes.
vec4 shadowPosition(int texel, vec3 place) {
    vec4 at = vec4(place, 1.0);
    return vec4(dot(texelFetch(shadowProjections, texel), at), dot(texelFetch(shadowProjections, texel + 1), at),
                dot(texelFetch(shadowProjections, texel + 2), at), dot(texelFetch(shadowProjections, texel + 3), at));
}
