// Writes depth (m), signed circle of confusion (px) and fractional level of the nearest surface seen through the pinhole.

#include "include/frame.glsl"
#include "include/lens.glsl"

in Surface {
#include "include/surface_varyings.glsl"
} surface;

#ifdef BASE_COLOR_TEXTURE
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif

layout(location = 0) out float depthOut;
layout(location = 1) out float cocOut;
layout(location = 2) out float levelOut;

void main() {
#ifdef ALPHA_MASK
    float alpha = surface.color.a;
#ifdef BASE_COLOR_TEXTURE
    vec4 rowU = material.uvRows[0];
    vec4 rowV = material.uvRows[1];
    vec2 uv = rowU.w == 0.0 ? surface.uv.xy : surface.uv.zw;
    alpha *= texture(baseColorTexture, vec2(dot(rowU.xyz, vec3(uv, 1.0)), dot(rowV.xyz, vec3(uv, 1.0)))).a;
#endif
    if (alpha < material.emissiveCutoff.w) discard;
#endif
    float w = 1.0 / gl_FragCoord.w;
    depthOut = w;
#ifdef OWN_BLUR
    vec2 ownBlur = surface.ownBlur;
#else
    const vec2 ownBlur = vec2(1.0, 0.0);
#endif
    vec2 size = frame.coc.z * vec2(1.0, frame.projection.x / frame.projection.y);
    cocOut = circleOfConfusion(gl_FragCoord.z, ndcOfPixel(gl_FragCoord.xy, ivec2(size + 0.5)), ownBlur);
    levelOut = object.values.x;
}
