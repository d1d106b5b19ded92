// Draws a shadow caster; only depth is written. A partially transmitting caster covers the matching share of the
// texels, different ones in each lens sample (Enderton et al. 2010, Stochastic Transparency).

#include "include/frame.glsl"

in Surface {
#include "include/surface_varyings.glsl"
} surface;
flat in float ditherOffset;

#ifdef BASE_COLOR_TEXTURE
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif

#if defined(ALPHA_BLEND) || defined(LETS_LIGHT_PASS)
// Returns a threshold that is evenly distributed over the texels, and over the samples in each texel (Roberts 2018).
// SCREEN_DOOR in accumulation/object.frag uses the same pattern.
float threshold() {
    uvec2 texel = uvec2(gl_FragCoord.xy);
    uint place = texel.x * 3242174889u + texel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return fract(float(place >> 8) / 16777216.0 + ditherOffset);
}
#endif

void main() {
#if defined(ALPHA_MASK) || defined(ALPHA_BLEND) || defined(LETS_LIGHT_PASS)
    vec4 color = surface.color;
#ifdef BASE_COLOR_TEXTURE
    vec4 rowU = material.uvRows[0];
    vec4 rowV = material.uvRows[1];
    vec2 uv = rowU.w == 0.0 ? surface.uv.xy : surface.uv.zw;
    color *= texture(baseColorTexture, vec2(dot(rowU.xyz, vec3(uv, 1.0)), dot(rowV.xyz, vec3(uv, 1.0))));
#endif
#ifdef ALPHA_MASK
    if (color.a < material.emissiveCutoff.w) discard;
#endif
    float hidden = 1.0;
#ifdef LETS_LIGHT_PASS
    hidden -= material.transmission.x * (1.0 - material.surface.x) * dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
#endif
#ifdef ALPHA_BLEND
    hidden *= color.a;
#endif
#if defined(ALPHA_BLEND) || defined(LETS_LIGHT_PASS)
    if (hidden <= threshold()) discard;
#endif
#endif
}
