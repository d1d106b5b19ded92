// Draws a shadow caster; only depth is written. A caster that transmits a part of the light covers the corresponding
// fraction of the texels, different texels in each lens sample (Enderton et al. 2010, Stochastic Transparency).
// Coloured transmission is converted to its luminance.

#include "include/frame.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"
#include "include/alpha_mask.glsl"
#include "include/transmittance.glsl"

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv)); }

void main() {
    readSurface();
    vec4 color = texturedColor(surface.color);
    uvec2 texel = uvec2(gl_FragCoord.xy);
    if (alphaTested && maskHides(color.a, surface.color.a, texel, 0.0)) discard;
    float hidden = 1.0;
    if (letsLightPass) {
        float metallic = material.surface.x * materialTexel(metallicRoughnessTexture).b;
        hidden -= transmittedShare(metallic) * dot(transmittedTint(color.rgb, volumeThickness()), vec3(0.2126, 0.7152, 0.0722));
    }
    if (alphaBlended) hidden *= color.a;
    if ((alphaBlended || letsLightPass) && hidden <= ditherThreshold(texel, surface.ditherOffset)) discard;
}
