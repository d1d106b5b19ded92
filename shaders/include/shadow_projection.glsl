// How the shadow maps of a lens sample are drawn and read: src/plan/visible/shadows.h. SHADOW_MAPS: of one point on each light;
// SHADOW_POINTS: of those.

layout(binding = 19) uniform samplerBuffer shadowProjections;
layout(location = 2) uniform int firstShadowSample;   // in layer 0 of what is drawn

int shadowTexel(int layer, int slot) {
    return ((firstShadowSample + layer) * (SHADOW_POINTS * SHADOW_MAPS) + slot) * 6;
}

// Clip space of a direction, m along the world's axes.
vec4 shadowDirection(int texel, vec3 direction) {
    return vec4(dot(texelFetch(shadowProjections, texel).xyz, direction), dot(texelFetch(shadowProjections, texel + 1).xyz, direction),
                dot(texelFetch(shadowProjections, texel + 2).xyz, direction), dot(texelFetch(shadowProjections, texel + 3).xyz, direction));
}

// Clip space of a place, m from the camera along the world's axes.
vec4 shadowPosition(int texel, vec3 place) {
    vec4 at = vec4(place, 1.0);
    return vec4(dot(texelFetch(shadowProjections, texel), at), dot(texelFetch(shadowProjections, texel + 1), at),
                dot(texelFetch(shadowProjections, texel + 2), at), dot(texelFetch(shadowProjections, texel + 3), at));
}
