// Shades a surface from its interpolated attributes in the global variable `surface`.

// Each shader that includes this file defines the following two functions.
bool showsFront();                       // true if the triangle's front is visible
// Sets normalRight and normalUp of `point`, the changes of the normal from pixel to pixel. `normal` is the normalised
// interpolated normal.
void addNormalChanges(inout SurfacePoint point, vec3 normal);

// Returns the interpolated unit normal perturbed by the value `texel` of a normal map. `scale`: the map's normal scale.
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

vec3 shownNormal = vec3(0.0);     // normal used for shading, set by shaded()
vec3 shownEmission = vec3(0.0);

vec3 towardsViewer(vec3 normal) {
    if (doubleSided && !showsFront()) normal = -normal;
    return normal;
}

vec3 shadingNormal(vec3 normal) {
    if (normalTexture.x >= 0) normal = bumpedNormal(normal, materialTexel(normalTexture).xyz, material.surface.z);
    return towardsViewer(normal);
}

// Sets the reflectances F0 and F90 according to KHR_materials_ior and KHR_materials_specular.
void addReflectance(inout SurfacePoint point, vec3 baseColor, float metallic) {
    float share = material.reflectance.w * materialTexel(specularTexture).a;
    vec3 reflectance = material.reflectance.rgb * materialTexel(specularColorTexture).rgb;
    point.specular = mix(min(reflectance, vec3(1.0)) * share, baseColor, metallic);
    point.grazing = mix(share, 1.0, metallic);
}

void addCoat(inout SurfacePoint point, vec3 normal) {
    point.coat = material.coat.x * materialTexel(clearcoatTexture).r;
    point.coatRoughness = material.coat.y * materialTexel(clearcoatRoughnessTexture).g;
    if (clearcoatNormalTexture.x >= 0) normal = bumpedNormal(normal, materialTexel(clearcoatNormalTexture).xyz, material.coat.z);
    point.coatNormal = towardsViewer(normal);
}

void addSheen(inout SurfacePoint point) {
    point.sheen = material.sheen.rgb * materialTexel(sheenColorTexture).rgb;
    point.sheenRoughness = material.sheen.w * materialTexel(sheenRoughnessTexture).a;
}

// Sets the direction and the widths of stretched highlights (KHR_materials_anisotropy).
void addAnisotropy(inout SurfacePoint point) {
    vec2 direction = vec2(1.0, 0.0);
    float strength = material.anisotropy.x;
    if (anisotropyTexture.x >= 0) {
        vec3 texel = materialTexel(anisotropyTexture).xyz;
        direction = 2.0 * texel.xy - 1.0;
        strength *= texel.z;
    }
    direction = mat2(material.anisotropy.yz, vec2(-material.anisotropy.z, material.anisotropy.y)) * direction;
    vec3 tangent = surface.tangent.xyz - point.normal * dot(point.normal, surface.tangent.xyz);
    vec3 bitangent = cross(point.normal, tangent) * surface.tangent.w;
    vec3 stretch = direction.x * tangent + direction.y * bitangent;
    float width = point.roughness * point.roughness;
    float length2 = dot(stretch, stretch);
    if (length2 < 1e-12) strength = 0.0;
    point.stretch = length2 < 1e-12 ? vec3(0.0) : stretch * inversesqrt(length2);
    point.across = cross(point.normal, point.stretch);
    point.widths = max(vec2(mix(width, 1.0, strength * strength), width), 1e-3);
    point.mirror = strength > 0.0 ? stretchedNormal(point, strength) : point.normal;
}

// Sets the film of an iridescent surface. F0 must be set.
void addFilm(inout SurfacePoint point) {
    point.iridescence = material.film.x * materialTexel(iridescenceTexture).r;
    point.film = mix(material.film.z, material.film.w, materialTexel(iridescenceThicknessTexture).g);
    float cosine = max(dot(point.normal, point.toEye), 0.0);
    point.filmBase = schlickBase(filmReflectance(cosine, point.specular, material.film.y, point.film), cosine);
}

// Replaces a part of the diffuse reflection by diffuse transmission of light from behind the surface
// (KHR_materials_diffuse_transmission).
void addDiffuseTransmission(inout SurfacePoint point, float metallic) {
    float share = material.through.w * materialTexel(diffuseTransmissionTexture).a;
    point.through = (1.0 - metallic) * share * material.through.rgb * materialTexel(diffuseTransmissionColorTexture).rgb;
    point.diffuse *= 1.0 - share;
}

float surfaceCoverage = 1.0;   // alpha of the surface over a transparent background

#ifdef TRANSMISSIVE
#include "include/transmission.glsl"
#else
void addTransmission(inout SurfacePoint point, vec3 baseColor, float metallic) {}
#endif

#ifdef SHADOWED
#include "include/shadows.glsl"
#else
void addShadows(inout SurfacePoint point, vec3 place) {}
#endif

vec3 shaded(vec3 baseColor) {
    float metallic = material.surface.x;
    float roughness = material.surface.y;
    float occlusion = 1.0;
    if (metallicRoughnessTexture.x >= 0) {
        vec2 roughnessMetallic = materialTexel(metallicRoughnessTexture).gb;
        roughness *= roughnessMetallic.x;
        metallic *= roughnessMetallic.y;
    }
    if (occlusionTexture.x >= 0) occlusion += material.surface.w * (materialTexel(occlusionTexture).r - 1.0);
    SurfacePoint point;
    point.diffuse = baseColor * (1.0 - metallic);
    point.specular = mix(vec3(0.04), baseColor, metallic);
    point.roughness = roughness;
    vec3 normal = normalize(surface.normal);
    point.normal = shadingNormal(normal);
    point.toEye = normalize(surface.toEye);
    addNormalChanges(point, normal);
    shownNormal = point.normal;
    if (emissive) point.emission = material.emissiveCutoff.rgb * materialTexel(emissiveTexture).rgb;
    if (emissive) shownEmission = point.emission;
    if (coarseLevel) {
        point.agreement = clamp(surface.agreement, 0.05, 1.0);   // interpolation in narrow triangles may leave (0, 1]
        point.spread = normalSpread(point.agreement);
        point.seen = seenNormal(point.normal, point.toEye, point.agreement, point.spread);
    }
    if (ownReflectance) addReflectance(point, baseColor, metallic);
    if (anisotropic) addAnisotropy(point);
    if (iridescent) addFilm(point);
    if (diffusesThrough) addDiffuseTransmission(point, metallic);
    if (clearcoat) addCoat(point, normal);
    if (sheen) addSheen(point);
    addShadows(point, surface.position);
    addTransmission(point, baseColor, metallic);
    return radianceOf(point, surface.position, occlusion);
}

vec3 surfaceRadiance(vec3 baseColor) {
    vec3 radiance = lit ? shaded(baseColor) : baseColor;
    // NaN from a texel or a narrow triangle becomes black, because NaN would persist in the sum of all samples.
    return any(isnan(radiance)) ? vec3(0.0) : radiance;
}
