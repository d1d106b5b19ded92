// Shades one lens sample of a surface into its layer.

#include "include/frame.glsl"
#include "include/layer_format.glsl"
#include "include/environment.glsl"
#include "include/shading.glsl"

in Surface {
#include "include/surface_varyings.glsl"
} surface;
flat in float ditherOffset;

#ifdef BASE_COLOR_TEXTURE
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif
#ifdef METALLIC_ROUGHNESS_TEXTURE
layout(binding = 1) uniform sampler2D metallicRoughnessTexture;
#endif
#ifdef NORMAL_TEXTURE
layout(binding = 2) uniform sampler2D normalTexture;
#endif
#ifdef OCCLUSION_TEXTURE
layout(binding = 3) uniform sampler2D occlusionTexture;
#endif
#ifdef EMISSIVE_TEXTURE
layout(binding = 4) uniform sampler2D emissiveTexture;
#endif

#ifdef LAYER_RGB9E5
layout(location = 0) out uint layerOut;
#else
layout(location = 0) out vec4 layerOut;
#endif

#ifdef TEXTURED
vec2 uvOf(int slot) {
    vec4 rowU = material.uvRows[2 * slot];
    vec4 rowV = material.uvRows[2 * slot + 1];
    vec2 uv = rowU.w == 0.0 ? surface.uv.xy : surface.uv.zw;
    return vec2(dot(rowU.xyz, vec3(uv, 1.0)), dot(rowV.xyz, vec3(uv, 1.0)));
}
#endif

#ifndef UNLIT
vec3 shadingNormal() {
    vec3 normal = normalize(surface.normal);
#ifdef NORMAL_TEXTURE
    vec3 tangent = surface.tangent.xyz - normal * dot(normal, surface.tangent.xyz);
    float tangent2 = dot(tangent, tangent);
    if (tangent2 > 1e-12) {
        tangent *= inversesqrt(tangent2);
        vec3 bitangent = cross(normal, tangent) * surface.tangent.w;
        vec3 local = texture(normalTexture, uvOf(2)).xyz * 2.0 - 1.0;
        local.xy *= material.surface.z;
        normal = normalize(mat3(tangent, bitangent, normal) * local);
    }
#endif
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) normal = -normal;
#endif
    return normal;
}

vec3 shaded(vec3 baseColor) {
    float metallic = material.surface.x;
    float roughness = material.surface.y;
    float occlusion = 1.0;
#ifdef METALLIC_ROUGHNESS_TEXTURE
    vec2 roughnessMetallic = texture(metallicRoughnessTexture, uvOf(1)).gb;
    roughness *= roughnessMetallic.x;
    metallic *= roughnessMetallic.y;
#endif
#ifdef OCCLUSION_TEXTURE
    occlusion = 1.0 + material.surface.w * (texture(occlusionTexture, uvOf(3)).r - 1.0);
#endif
    SurfacePoint point;
    point.diffuse = baseColor * (1.0 - metallic);
    point.specular = mix(vec3(0.04), baseColor, metallic);
    point.roughness = roughness;
    point.normal = shadingNormal();
    point.toEye = normalize(surface.toEye);
#ifdef COARSE_LEVEL
    point.agreement = clamp(surface.agreement, 0.05, 1.0);   // a sliver may extrapolate
#endif
#ifdef LOCAL_LIGHTS
    return reflectedRadiance(point, surface.position, occlusion);
#else
    return reflectedRadiance(point, vec3(0.0), occlusion);
#endif
}
#endif

void main() {
    vec4 baseColor = surface.color;
#ifdef BASE_COLOR_TEXTURE
    baseColor *= texture(baseColorTexture, uvOf(0));
#endif
#ifdef ALPHA_MASK
    if (baseColor.a < material.emissiveCutoff.w) discard;
#endif
#ifdef UNLIT
    vec3 radiance = baseColor.rgb;
#else
    vec3 emissive = material.emissiveCutoff.rgb;
#ifdef EMISSIVE_TEXTURE
    emissive *= texture(emissiveTexture, uvOf(4)).rgb;
#endif
    vec3 radiance = shaded(baseColor.rgb) + emissive;
#endif

    // A texel or a sliver without a value is black, not a hole that no later sample could fill.
    if (any(isnan(radiance))) radiance = vec3(0.0);
#ifdef LAYER_LARGEST
    radiance = min(radiance, vec3(LAYER_LARGEST));
#endif
#ifdef LAYER_RGB9E5
    layerOut = encodeLayer(vec4(radiance, 1.0), ditherOffset);
#elif defined(ALPHA_BLEND)
    layerOut = vec4(radiance * baseColor.a, baseColor.a);
#else
    layerOut = vec4(radiance, 1.0);
#endif
}
