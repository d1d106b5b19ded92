// Draws a shadow caster; only depth is written. A caster that transmits a part of the light covers the corresponding
// fraction of the texels, different texels in each lens sample and each map (include/alpha_choice.glsl). Colours count by
// their luminance.

#include "include/frame.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"
#include "include/alpha_mask.glsl"
#include "include/transmittance.glsl"

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv)); }

void main() {
    readSurface();
    vec4 color = texturedColor(surface.color);
#ifdef CHOOSES_BY_ALPHA
    // The maps of a lens sample lie side by side.
    uint map = uint(surface.layer) % uint(shadowPoints * shadowMapCount);
    uvec2 texel = uvec2(gl_FragCoord.xy) + uvec2(map * uint(shadowSize), 0u);
    if (alphaTested && maskHides(color.a, surface.color.a, texel, 0.0)) discard;
    float hidden = 1.0;
    if (letsLightPass) {
        float metallic = material.surface.x * materialTexel(metallicRoughnessTexture).b;
        hidden -= transmittedShare(metallic) * dot(transmittedTint(color.rgb, volumeThickness()), vec3(0.2126, 0.7152, 0.0722));
    }
    if (alphaBlended) hidden *= color.a;
    if ((alphaBlended || letsLightPass) && hidden <= alphaThreshold(texel)) discard;
#endif
}
