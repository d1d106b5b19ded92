// Computes the radiance from behind a surface that transmits light.

#include "include/transmittance.glsl"

// Copy of all layers from before this object was drawn: the background seen through the object.
layout(binding = 28) uniform sampler2DArray backdrop;

vec2 ndcThroughLens(vec3 viewPosition) {
    vec4 clip = throughLens(pinholePosition(viewPosition), vec2(1.0, 0.0), vec4(surface.lens, 0.0, 0.0));
    return clip.xy / clip.w;
}

// Returns the background colour at the surface's position plus `offset` (in m, world axes). `roughness` (0 … 1) blurs
// the background as in Khronos's glTF Sample Viewer; 1 blurs over the entire image. The lookup is jittered per lens
// sample, so that the blocky texels of coarse mip levels average out over the samples.
vec4 seenBehind(vec3 offset, float roughness) {
    if (chromatic) bandShift = surface.bandShift;
    ivec2 size = textureSize(backdrop, 0).xy;
    vec2 at = gl_FragCoord.xy / vec2(size);
    if (offset != vec3(0.0)) {
        mat3 worldFromView = mat3(frame.worldFromView);
        at += 0.5 * (ndcThroughLens((surface.position + offset) * worldFromView) - ndcThroughLens(surface.position * worldFromView));
    }
    float level = roughness * log2(float(size.x / positionsPerAxis));
    if (roughness > 0.0) level += log2(float(positionsPerAxis));
    uint turn = uint(surface.sampleNumber) * 2654435769u;   // 2³² / golden ratio
    at += (exp2(level) - 1.0) * (vec2(fractionOf(turn + (1u << 31)), fractionOf(17u * turn + (1u << 31))) - 0.5) / vec2(size);
    return textureLod(backdrop, vec3(at, gl_Layer), level);
}

// Adds transmitted light (KHR_materials_transmission and KHR_materials_volume). Through a thin wall, the background
// straight behind the wall is visible. Through a volume, the background at the end of the refracted ray is visible.
void addTransmission(inout SurfacePoint point, vec3 baseColor, float metallic) {
    float share = transmittedShare(metallic);
    if (diffusesThrough) point.through *= 1.0 - share;
    vec3 way = volumeThickness() * refract(-point.toEye, point.normal, material.transmission.z);
    vec4 behind = seenBehind(way, point.roughness * material.transmission.w);
    vec3 tint = transmittedTint(baseColor, length(way));
    if (dispersive) {
        // Red and blue have the refractive indices n ∓ (n − 1)·dispersion/40 (KHR_materials_dispersion).
        float n = 1.0 / material.transmission.z;
        for (int channel = 0; channel < 3; channel += 2) {
            float ior = n + float(channel - 1) * 0.025 * (n - 1.0) * material.absorption.w;
            vec3 ofChannel = volumeThickness() * refract(-point.toEye, point.normal, 1.0 / max(ior, 1.0));
            behind[channel] = seenBehind(ofChannel, point.roughness * material.transmission.w)[channel];
            tint[channel] = transmittedTint(baseColor, length(ofChannel))[channel];
        }
    }
    point.diffuse *= 1.0 - share;
    point.transmitted = share * tint * behind.rgb;
    surfaceCoverage = 1.0 - share * (1.0 - behind.a) * max(tint.r, max(tint.g, tint.b));
}
