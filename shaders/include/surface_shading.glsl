// Surface shading from the interpolated `surface`. The including stage must define
//   SURFACE_TEXTURE(map, slot)    a texture sample at uvOf(slot, …), filtered over the pixel
//   SURFACE_SHOWS_FRONT           true if the front is visible
//   surfaceFootprint(normal)      SurfacePoint::footprint of the normalised interpolated normal
// and, for TRANSMISSION,
//   seenBehind(offset, roughness) the premultiplied colour behind the surface at `offset` from it (m, world)

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
#ifdef SPECULAR_TEXTURE
layout(binding = 8) uniform sampler2D specularTexture;
#endif
#ifdef SPECULAR_COLOR_TEXTURE
layout(binding = 9) uniform sampler2D specularColorTexture;
#endif
#ifdef TRANSMISSION_TEXTURE
layout(binding = 10) uniform sampler2D transmissionTexture;
#endif
#ifdef THICKNESS_TEXTURE
layout(binding = 11) uniform sampler2D thicknessTexture;
#endif
#ifdef CLEARCOAT_TEXTURE
layout(binding = 12) uniform sampler2D clearcoatTexture;
#endif
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE
layout(binding = 13) uniform sampler2D clearcoatRoughnessTexture;
#endif
#ifdef CLEARCOAT_NORMAL_TEXTURE
layout(binding = 14) uniform sampler2D clearcoatNormalTexture;
#endif
#ifdef SHEEN_COLOR_TEXTURE
layout(binding = 15) uniform sampler2D sheenColorTexture;
#endif
#ifdef SHEEN_ROUGHNESS_TEXTURE
layout(binding = 16) uniform sampler2D sheenRoughnessTexture;
#endif

#ifdef TEXTURED
// Returns the texture coordinates for texture `slot`, from both UV sets.
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
#ifdef TANGENTS
// Returns the interpolated normal perturbed by `texel` of a normal map.
vec3 bumpedNormal(vec3 normal, vec3 texel, float scale) {
    vec3 tangent = surface.tangent.xyz - normal * dot(normal, surface.tangent.xyz);
    float tangent2 = dot(tangent, tangent);
    if (tangent2 > 1e-12) {
        tangent *= inversesqrt(tangent2);
        vec3 bitangent = cross(normal, tangent) * surface.tangent.w;
        vec3 local = texel * 2.0 - 1.0;
        local.xy *= scale;
        normal = normalize(mat3(tangent, bitangent, normal) * local);
    }
    return normal;
}
#endif

vec3 towardsViewer(vec3 normal) {
#ifdef DOUBLE_SIDED
    if (!SURFACE_SHOWS_FRONT) normal = -normal;
#endif
    return normal;
}

vec3 shadingNormal(vec3 normal) {
#ifdef NORMAL_TEXTURE
    normal = bumpedNormal(normal, SURFACE_TEXTURE(normalTexture, 2).xyz, material.surface.z);
#endif
    return towardsViewer(normal);
}

#ifdef OWN_REFLECTANCE
// Adds KHR_materials_ior and KHR_materials_specular.
void addReflectance(inout SurfacePoint point, vec3 baseColor, float metallic) {
    float share = material.reflectance.w;
    vec3 reflectance = material.reflectance.rgb;
#ifdef SPECULAR_TEXTURE
    share *= SURFACE_TEXTURE(specularTexture, 5).a;
#endif
#ifdef SPECULAR_COLOR_TEXTURE
    reflectance *= SURFACE_TEXTURE(specularColorTexture, 6).rgb;
#endif
    point.specular = mix(min(reflectance, vec3(1.0)) * share, baseColor, metallic);
    point.grazing = mix(share, 1.0, metallic);
}
#endif

#ifdef CLEARCOAT
void addCoat(inout SurfacePoint point, vec3 normal) {
    point.coat = material.coat.x;
    point.coatRoughness = material.coat.y;
#ifdef CLEARCOAT_TEXTURE
    point.coat *= SURFACE_TEXTURE(clearcoatTexture, 9).r;
#endif
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE
    point.coatRoughness *= SURFACE_TEXTURE(clearcoatRoughnessTexture, 10).g;
#endif
#ifdef CLEARCOAT_NORMAL_TEXTURE
    normal = bumpedNormal(normal, SURFACE_TEXTURE(clearcoatNormalTexture, 11).xyz, material.coat.z);
#endif
    point.coatNormal = towardsViewer(normal);
}
#endif

#ifdef SHEEN
void addSheen(inout SurfacePoint point) {
    point.sheen = material.sheen.rgb;
    point.sheenRoughness = material.sheen.w;
#ifdef SHEEN_COLOR_TEXTURE
    point.sheen *= SURFACE_TEXTURE(sheenColorTexture, 12).rgb;
#endif
#ifdef SHEEN_ROUGHNESS_TEXTURE
    point.sheenRoughness *= SURFACE_TEXTURE(sheenRoughnessTexture, 13).a;
#endif
}
#endif

#ifdef TRANSMISSION
float surfaceCoverage = 1.0;   // alpha of the surface over a transparent background

// KHR_materials_transmission and KHR_materials_volume. A thin wall shows the background straight behind it. A volume
// shows the background at the end of the refracted ray, after the volume's thickness, with Beer–Lambert absorption.
void addTransmission(inout SurfacePoint point, vec3 baseColor, float metallic) {
    float share = material.transmission.x;
    float thickness = material.transmission.y;
#ifdef TRANSMISSION_TEXTURE
    share *= SURFACE_TEXTURE(transmissionTexture, 7).r;
#endif
#ifdef THICKNESS_TEXTURE
    thickness *= SURFACE_TEXTURE(thicknessTexture, 8).g;
#endif
    float scale = pow(abs(determinant(mat3(object.viewFromObject))), 1.0 / 3.0);
    vec3 way = scale * thickness * refract(-point.toEye, point.normal, material.transmission.z);
    vec4 behind = seenBehind(way, point.roughness * material.transmission.w);
    vec3 tint = baseColor * exp(-material.absorption.rgb * length(way));
    share *= 1.0 - metallic;
    point.diffuse *= 1.0 - share;
    point.transmitted = share * tint * behind.rgb;
    surfaceCoverage = 1.0 - share * (1.0 - behind.a) * max(tint.r, max(tint.g, tint.b));
}
#endif

#ifdef EMISSIVE
vec3 emittedRadiance() {
    vec3 emissive = material.emissiveCutoff.rgb;
#ifdef EMISSIVE_TEXTURE
    emissive *= SURFACE_TEXTURE(emissiveTexture, 4).rgb;
#endif
    return emissive;
}
#endif

#ifdef SHADOWS
#include "include/shadows.glsl"

void addShadows(inout SurfacePoint point, vec3 place) {
    vec3 across = cross(dFdx(place), dFdy(place));
    float across2 = dot(across, across);
    Facet facet = Facet(place, across2 > 0.0 ? across * inversesqrt(across2) : point.normal);
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        vec3 toLight = -lighting.lights[i].directionType.xyz;
#ifdef LOCAL_LIGHTS
        if (lighting.lights[i].directionType.w != 0.0) toLight = normalize(frame.lightPositions[i].xyz - place);
#endif
        point.lightShares[i] = lightShare(i, facet, toLight);
    }
    point.hidden = hiddenIrradiance(facet, point.normal);
}
#endif

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
#ifdef EMISSIVE
    point.emission = emittedRadiance();
#endif
#ifdef COARSE_LEVEL
    point.agreement = clamp(surface.agreement, 0.05, 1.0);   // narrow triangles may extrapolate
    point.spread = normalSpread(point.agreement);
    point.seen = seenNormal(point.normal, point.toEye, point.agreement, point.spread);
#endif
#ifdef OWN_REFLECTANCE
    addReflectance(point, baseColor, metallic);
#endif
#ifdef CLEARCOAT
    addCoat(point, normal);
#endif
#ifdef SHEEN
    addSheen(point);
#endif
#ifdef SHADOWS
    addShadows(point, surface.position);
#endif
#ifdef TRANSMISSION
    addTransmission(point, baseColor, metallic);
#endif
#ifdef LOCAL_LIGHTS
    return radianceOf(point, surface.position, occlusion);
#else
    return radianceOf(point, vec3(0.0), occlusion);
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
#endif
    // NaN from a texel or a narrow triangle becomes black. Otherwise it would persist in the sum of all samples.
    return any(isnan(radiance)) ? vec3(0.0) : radiance;
}
