// glTF 2.0 metallic-roughness: Lambert and GGX (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014) and Schlick's
// Fresnel; the environment's specular part by Karis's fit (2014, Physically Based Shading on Mobile).

struct SurfacePoint {
    vec3 diffuse;         // albedo of the diffuse part
    vec3 specular;        // reflectance at normal incidence
    float roughness;      // perceptual
    vec3 normal;          // unit, view space
    vec3 toEye;           // unit, view space
};

vec3 reflectedLight(SurfacePoint point, vec3 toLight, vec3 illuminance) {
    float nl = dot(point.normal, toLight);
    if (nl <= 0.0) return vec3(0.0);
    vec3 halfway = normalize(toLight + point.toEye);
    float nv = max(dot(point.normal, point.toEye), 1e-4);
    float nh = clamp(dot(point.normal, halfway), 0.0, 1.0);
    float vh = clamp(dot(point.toEye, halfway), 0.0, 1.0);
    float alpha = max(point.roughness * point.roughness, 1e-3);
    float alpha2 = alpha * alpha;
    float base = nh * nh * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (base * base);                       // times 1/π below
    float masking = 0.5 / (nl * sqrt(nv * nv * (1.0 - alpha2) + alpha2) + nv * sqrt(nl * nl * (1.0 - alpha2) + alpha2));
    float grazing = 1.0 - vh;
    float grazing2 = grazing * grazing;
    vec3 fresnel = point.specular + (1.0 - point.specular) * (grazing2 * grazing2 * grazing);
    return (point.diffuse * (1.0 - fresnel) + fresnel * (distribution * masking)) * illuminance * (nl * 0.31830988618);
}

vec3 punctualLight(SurfacePoint point, LightData light, vec3 viewPosition) {
    if (light.directionType.w == 0.0) return reflectedLight(point, -light.directionType.xyz, light.colorScale.rgb);
    vec3 offset = light.positionRange.xyz - viewPosition;
    float distance2 = max(dot(offset, offset), 1e-8);
    vec3 toLight = offset * inversesqrt(distance2);
    float falloff = 1.0 / distance2;
    if (light.positionRange.w > 0.0) {                                 // KHR_lights_punctual's recommended window
        float ratio2 = distance2 / (light.positionRange.w * light.positionRange.w);
        falloff *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    }
    if (light.directionType.w == 2.0) {
        float cone = clamp(dot(light.directionType.xyz, -toLight) * light.colorScale.w + light.cone.x, 0.0, 1.0);
        falloff *= cone * cone;
    }
    return reflectedLight(point, toLight, light.colorScale.rgb * falloff);
}

vec3 environmentLight(SurfacePoint point, float occlusion) {
#if ENVIRONMENT == 0
    return vec3(0.0);
#else
    mat3 worldFromView = mat3(frame.worldFromView);
    vec3 normal = worldFromView * point.normal;
    vec3 mirrored = worldFromView * reflect(-point.toEye, point.normal);
    vec3 diffuse = environmentDiffuse(normal);
    float rough = point.roughness;
#if ENVIRONMENT == 3
    vec3 reflection = environmentRadiance(mirrored, rough * ENVIRONMENT_LEVELS);
#elif ENVIRONMENT == 2
    vec3 reflection = mix(environmentRadiance(mirrored, 0.0), environmentDiffuse(mirrored), rough);
#else
    vec3 reflection = diffuse;
#endif
    float nv = clamp(dot(point.normal, point.toEye), 0.0, 1.0);
    vec4 r = rough * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 fit = vec2(-1.04, 1.04) * a + r.zw;
    return (point.diffuse * diffuse + (point.specular * fit.x + fit.y) * reflection) *
           (occlusion * ENVIRONMENT_LIGHTING);
#endif
}
