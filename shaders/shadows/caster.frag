// Draws a shadow caster. A caster that transmits a part of the light covers a fraction of the texels that equals the
// blocked fraction of the light. The choice of texels differs between lens samples and between maps
// (include/alpha_choice.glsl). With tintedShadows, each colour channel has its own fraction, and each channel of the
// output is the depth of the surface that hides the channel (McGuire and Enderton 2011, Colored Stochastic Shadow
// Maps). Otherwise only depth is written, and the luminance of the transmitted colour determines the fraction.

#include "include/frame.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"
#include "include/alpha_mask.glsl"
#include "include/transmittance.glsl"

#ifdef TINTED_SHADOWS
layout(location = 0) out vec4 depthsOut;   // reversed depth per channel; 0: nothing hides the channel's light
#endif

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv)); }

void main() {
    readSurface();
    vec4 color = texturedColor(surface.color);
#ifdef CHOOSES_BY_ALPHA
    // alphaThreshold() depends on the texel's position. Positions are counted as if the shadow maps of a lens sample
    // lay side by side, so that each map gets different thresholds.
    uint map = uint(surface.layer) % uint(shadowPoints * shadowMapCount);
    uvec2 texel = uvec2(gl_FragCoord.xy) + uvec2(map * uint(shadowSize), 0u);
    if (alphaTested && maskHides(color.a, surface.color.a, texel, 0.0)) discard;
    vec3 hidden = vec3(1.0);
    if (letsLightPass) {
        float metallic = material.surface.x * materialTexel(metallicRoughnessTexture).b;
        // The thickness of a volume is measured from its front to its back, so only the front absorbs light.
        vec3 tint = transmittedTint(color.rgb, gl_FrontFacing ? volumeThickness() : 0.0);
        if (!tintedShadows) tint = vec3(dot(tint, vec3(0.2126, 0.7152, 0.0722)));
        hidden -= transmittedShare(metallic) * tint;
    }
    if (alphaBlended) hidden *= color.a;
    bvec3 hides = alphaTested && !letsLightPass ? bvec3(true) : greaterThan(hidden, vec3(alphaThreshold(texel)));
    if (!any(hides)) discard;
#else
    const bvec3 hides = bvec3(true);
#endif
#ifdef TINTED_SHADOWS
    depthsOut = vec4(vec3(hides) * gl_FragCoord.z, 0.0);
#endif
}
