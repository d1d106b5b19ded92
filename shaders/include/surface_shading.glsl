// What a surface shows of its material and its light, from the interpolated `surface`. The stage that includes this says beforehand
//   SURFACE_TEXTURE(map, slot)    a texture where uvOf(slot, …) says, filtered over the pixel
//   SURFACE_SHOWS_FRONT           whether its front is seen
//   surfaceFootprint(normal)      SurfacePoint::footprint of the interpolated normal, which was given its length

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

#ifdef TEXTURED
// Where texture `slot` is read, from both sets of texture coordinates.
vec2 uvOf(int slot, vec4 uvSets) {
#ifndef UV_TRANSFORMS
    return uvSets.xy;
#else
    vec4 rowU = material.uvRows[2 * slot];
    vec4 rowV = material.uvRows[2 * slot + 1];
    vec2 uv = rowU.w == 0.0 ? uvSets.xy : uvSets.zw;
    return vec2(dot(rowU.xyz, vec3(uv, 1.0)), dot(rowV.xyz, vec3(uv, 1.0)));
#endif
}
#endif

#ifndef UNLIT
vec3 shadingNormal(vec3 normal) {
#ifdef NORMAL_TEXTURE
    vec3 tangent = surface.tangent.xyz - normal * dot(normal, surface.tangent.xyz);
    float tangent2 = dot(tangent, tangent);
    if (tangent2 > 1e-12) {
        tangent *= inversesqrt(tangent2);
        vec3 bitangent = cross(normal, tangent) * surface.tangent.w;
        vec3 local = SURFACE_TEXTURE(normalTexture, 2).xyz * 2.0 - 1.0;
        local.xy *= material.surface.z;
        normal = normalize(mat3(tangent, bitangent, normal) * local);
    }
#endif
#ifdef DOUBLE_SIDED
    if (!SURFACE_SHOWS_FRONT) normal = -normal;
#endif
    return normal;
}

vec3 shaded(vec3 baseColor) {
    float metallic = material.surface.x;
    float roughness = material.surface.y;
    float occlusion = 1.0;
#ifdef METALLIC_ROUGHNESS_TEXTURE
    vec2 roughnessMetallic = SURFACE_TEXTURE(metallicRoughnessTexture, 1).gb;
    roughness *= roughnessMetallic.x;
    metallic *= roughnessMetallic.y;
#endif
#ifdef OCCLUSION_TEXTURE
    occlusion = 1.0 + material.surface.w * (SURFACE_TEXTURE(occlusionTexture, 3).r - 1.0);
#endif
    SurfacePoint point;
    point.diffuse = baseColor * (1.0 - metallic);
    point.specular = mix(vec3(0.04), baseColor, metallic);
    point.roughness = roughness;
    vec3 normal = normalize(surface.normal);
    point.normal = shadingNormal(normal);
    point.toEye = normalize(surface.toEye);
    point.footprint = surfaceFootprint(normal);
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

vec4 texturedColor(vec4 baseColor) {
#ifdef BASE_COLOR_TEXTURE
    baseColor *= SURFACE_TEXTURE(baseColorTexture, 0);
#endif
    return baseColor;
}

vec3 surfaceRadiance(vec3 baseColor) {
#ifdef UNLIT
    vec3 radiance = baseColor;
#else
    vec3 radiance = shaded(baseColor);
#ifdef EMISSIVE
    vec3 emissive = material.emissiveCutoff.rgb;
#ifdef EMISSIVE_TEXTURE
    emissive *= SURFACE_TEXTURE(emissiveTexture, 4).rgb;
#endif
    radiance += emissive;
#endif
#endif
    // A texel or a sliver without a value is black, not a hole that no later sample could fill.
    return any(isnan(radiance)) ? vec3(0.0) : radiance;
}
