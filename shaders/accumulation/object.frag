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

#if defined(COC_SCALES) && defined(READS_COC_SCALE)
layout(location = 1) out vec4 cocScaleOut;
#endif

#ifdef LEVEL_COLOR_RANGE
layout(location = 0) uniform vec4 leastColor;   // of the level's vertices
layout(location = 1) uniform vec4 mostColor;
#endif

// Rasterisers round corners to a fraction of a pixel, so a triangle that is narrower than that can cover a pixel far outside its own
// plane equations. What the corners have bounds what lies between them. Normals and directions need no bound, as only their way
// counts, and texture coordinates that run as fast pick the smallest mipmap.
vec4 surfaceColor() {
#if defined(VERTEX_COLOR_RANGES)
    vec4 most = floor(surface.colorRange / 256.0);
    vec4 least = surface.colorRange - 256.0 * most;
    return clamp(surface.color, material.baseColor * (least / 255.0), material.baseColor * (most / 255.0));
#elif defined(LEVEL_COLOR_RANGE)
    return clamp(surface.color, material.baseColor * leastColor, material.baseColor * mostColor);
#else
    return surface.color;
#endif
}

#ifdef TEXTURED
vec2 uvOf(int slot) {
#ifndef UV_TRANSFORMS
    return surface.uv.xy;
#else
    vec4 rowU = material.uvRows[2 * slot];
    vec4 rowV = material.uvRows[2 * slot + 1];
    vec2 uv = rowU.w == 0.0 ? surface.uv.xy : surface.uv.zw;
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
    vec3 normal = normalize(surface.normal);
    point.normal = shadingNormal(normal);
    point.toEye = normalize(surface.toEye);
    vec3 right = dFdx(normal);   // of the surface's: what a normal texture's mean is, its mipmaps say
    vec3 up = dFdy(normal);
    point.footprint = dot(right, right) + dot(up, up);
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

#ifdef SCREEN_DOOR
// Does this pixel of a boundary sample belong to the coarser level? Roberts 2018, The Unreasonable Effectiveness of
// Quasirandom Sequences: the R2 sequence as an ordered dither, x/ρ + y/ρ² modulo 1 with ρ³ = ρ + 1, in whole numbers
// of 2⁻³² and so the same on each device. Any share of the pixels is spread evenly; each object has its own offset.
bool drawsCoarser() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint place = pixel.x * 3242174889u + pixel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return float(place >> 8) < object.values.y * 16777216.0;
}
#endif

void main() {
#ifdef SCREEN_DOOR
    if (drawsCoarser() != SCREEN_DOOR) discard;
#endif
    vec4 baseColor = surfaceColor();
#ifdef BASE_COLOR_TEXTURE
    baseColor *= texture(baseColorTexture, uvOf(0));
#endif
#ifdef ALPHA_MASK
    if (baseColor.a < material.emissiveCutoff.w) discard;
#endif
#ifdef UNLIT
    vec3 radiance = baseColor.rgb;
#else
    vec3 radiance = shaded(baseColor.rgb);
#ifdef EMISSIVE
    vec3 emissive = material.emissiveCutoff.rgb;
#ifdef EMISSIVE_TEXTURE
    emissive *= texture(emissiveTexture, uvOf(4)).rgb;
#endif
    radiance += emissive;
#endif
#endif

#if defined(COC_SCALES) && defined(READS_COC_SCALE)
    cocScaleOut = vec4(surface.cocScale);
#endif
    // A texel or a sliver without a value is black, not a hole that no later sample could fill.
    if (any(isnan(radiance))) radiance = vec3(0.0);
#ifdef LAYER_RGB9E5
    layerOut = encodeLayer(vec4(radiance, 1.0), ditherOffset);
#else
#ifdef ALPHA_BLEND
    layerOut = vec4(radiance * baseColor.a, baseColor.a);
#else
    layerOut = vec4(radiance, 1.0);
#endif
#ifdef LAYER_LARGEST
    layerOut.rgb = roundedToHalf(layerOut.rgb);
#endif
#endif
}
