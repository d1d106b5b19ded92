// Draws a shadow caster; only depth is written. A caster that transmits a part of the light covers the corresponding
// fraction of the texels, different texels in each lens sample (Enderton et al. 2010, Stochastic Transparency).

#include "include/frame.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv)); }

// Returns a dither threshold in [0, 1) that is evenly distributed over neighbouring texels, and over the lens samples
// in each texel (Roberts 2018). drawsCoarser() in surface_light.glsl uses the same pattern.
float threshold() {
    uvec2 texel = uvec2(gl_FragCoord.xy);
    uint place = texel.x * 3242174889u + texel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return fract(float(place >> 8) / 16777216.0 + surface.ditherOffset);
}

void main() {
    readSurface();
    vec4 color = texturedColor(surface.color);
    if (alphaTested && color.a < material.emissiveCutoff.w) discard;
    float hidden = 1.0;
    if (letsLightPass)
        hidden -= material.transmission.x * (1.0 - material.surface.x) * dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
    if (alphaBlended) hidden *= color.a;
    if ((alphaBlended || letsLightPass) && hidden <= threshold()) discard;
}
