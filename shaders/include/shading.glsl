// glTF 2.0 metallic-roughness: Lambert and GGX (Walter et al. 2007) with Hammon's fit (2017, PBR Diffuse Lighting for GGX+Smith
// Microsurfaces) of the height-correlated Smith masking and Schlick's Fresnel; the environment's specular part by Karis's fit
// (2014, Physically Based Shading on Mobile).
//
// Fresnel is F = F0 + (1 − F0)·g with g = (1 − v·h)⁵, so the lights can be summed before F0 and the albedo are known: three sums,
// and few operations a light (software rasterisers feel each one).

struct SurfacePoint {
    vec3 diffuse;         // albedo of the diffuse part
    vec3 specular;        // reflectance at normal incidence, F0
    float roughness;      // perceptual
    vec3 normal;          // unit, along the world's axes as all directions here
    vec3 toEye;           // unit
#ifdef COARSE_LEVEL
    float agreement;      // length |n| of the mean of the normals that `normal` stands for, in (0, 1]
#endif
};

struct LightSums {
    vec3 diffuse;         // Σ E·(n·l)·(1 − g) / π
    vec3 specular;        // Σ E·(n·l)·D·V
    vec3 grazing;         // Σ E·(n·l)·D·V·g
};

#ifdef COARSE_LEVEL
// The mean of max(n·l, 0) over the normals that one stands for, whose cosine to the light is `cosine`. They have the mean |n| cosine
// and, if they spread alike to all sides, the variance σ² = (1 − |n|²)/2 · (1 − cosine²); for a normal distribution of mean μ the mean of
// the positive part is close to (μ + √(μ² + 2σ²/π)) / 2, which is exact for μ = 0 and for σ = 0.
float meanCosine(float cosine, float agreement) {
    float mean = agreement * cosine;
    float spread = 0.31830988618 * (1.0 - agreement * agreement) * max(1.0 - cosine * cosine, 0.0);
    return 0.5 * (mean + sqrt(mean * mean + spread));
}

// The normals that one stands for widen the reflection: a lobe of width α over slopes of variance σ² ≈ (1 − |n|)/|n| along each axis
// (Toksvig 2005, Mipmapping Normal Maps) is one of width √(α² + 2σ²).
float widenedAlpha(float alpha, float agreement) {
    return min(sqrt(alpha * alpha + 2.0 * (1.0 - agreement) / agreement), 1.0);
}
#endif

// One light of illuminance `illuminance` (over π) from the unit direction `toLight`. The half vector is known through its cosines
// only: |l + v|² = 2 + 2 l·v, (n·h)² = (n·l + n·v)² / |l + v|², (v·h)² = |l + v|² / 4.
void addLight(inout LightSums sums, SurfacePoint point, float nv, float alpha, vec3 toLight, vec3 illuminance) {
    float cosine = dot(point.normal, toLight);
    float nl = max(cosine, 0.0);
    float sum2 = max(2.0 + 2.0 * dot(toLight, point.toEye), 1e-6);
    float cosines = max(nl + nv, 0.0);
    float base = max(cosines * cosines * (alpha * alpha - 1.0) + sum2, alpha * alpha * sum2);  // (n·h)² ≤ 1
    float lobe = alpha * sum2;
    float masking = max(mix(2.0 * nl * nv, cosines, alpha), 1e-4);
    float specular = nv > 0.0 ? 0.5 * lobe * lobe / (base * base * masking) : 0.0;  // an averted normal reflects nothing
    float g = 1.0 - 0.5 * sqrt(sum2);
    float g2 = g * g;
    g = g2 * g2 * g;
#ifdef COARSE_LEVEL
    float matt = meanCosine(cosine, point.agreement);
#else
    float matt = nl;
#endif
    sums.diffuse += illuminance * (matt * (1.0 - g));
    vec3 received = illuminance * (nl * specular);
    sums.specular += received;
    sums.grazing += received * g;
}

// Falloff and direction of a point or spot light (KHR_lights_punctual).
vec3 localLight(LightData light, vec4 positionRange, vec3 position, out vec3 toLight) {
    vec3 offset = positionRange.xyz - position;
    float distance2 = max(dot(offset, offset), 1e-8);
    toLight = offset * inversesqrt(distance2);
    float falloff = 1.0 / distance2;
    if (positionRange.w > 0.0) {                                       // the extension's recommended window
        float ratio2 = distance2 / (positionRange.w * positionRange.w);
        falloff *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    }
    if (light.directionType.w == 2.0) {
        float cone = clamp(dot(light.directionType.xyz, -toLight) * light.colorScale.w + light.cone.x, 0.0, 1.0);
        falloff *= cone * cone;
    }
    return light.colorScale.rgb * falloff;
}

// The normal whose cosine gives the light that matt surfaces throw back.
vec3 mattNormal(SurfacePoint point) {
#ifdef COARSE_LEVEL
    return point.normal * point.agreement;
#else
    return point.normal;
#endif
}

// The environment's light on the point, `occlusion` of it.
vec3 environmentLight(SurfacePoint point, float nv, float occlusion) {
#if ENVIRONMENT == 0
    return vec3(0.0);
#else
#if ENVIRONMENT == 3
    vec3 diffuse = environmentDiffuse(mattNormal(point));
    vec3 reflection = environmentRadiance(reflect(-point.toEye, point.normal), point.roughness * ENVIRONMENT_LEVELS);
#elif ENVIRONMENT == 2
    // Only heights count: that of the mirrored direction 2 (n·v) n − v too.
    float mirroredHeight = 2.0 * nv * point.normal.y - point.toEye.y;
    vec3 diffuse = gradientDiffuse(mattNormal(point).y);
    vec3 reflection = mix(gradientRadiance(mirroredHeight), gradientDiffuse(mirroredHeight), point.roughness);
#else
    vec3 diffuse = lighting.environment[0].rgb;
    vec3 reflection = diffuse;
#endif
    vec4 r = point.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 fit = vec2(-1.04, 1.04) * a + r.zw;
    return (point.diffuse * diffuse + (point.specular * fit.x + fit.y) * reflection) * (occlusion * ENVIRONMENT_LIGHTING);
#endif
}

// Radiance towards the eye, without emission. `position`, from the camera, matters to point and spot lights only.
vec3 reflectedRadiance(SurfacePoint point, vec3 position, float occlusion) {
    float nv = dot(point.normal, point.toEye);   // may be below 0: an interpolated normal can look away
    float alpha = max(point.roughness * point.roughness, 1e-3);
#ifdef COARSE_LEVEL
    alpha = widenedAlpha(alpha, point.agreement);
    point.roughness = sqrt(alpha);
#endif
    LightSums sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0));
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        vec3 toLight = -lighting.lights[i].directionType.xyz;
        vec3 illuminance = lighting.lights[i].colorScale.rgb;
#ifdef LOCAL_LIGHTS
        if (lighting.lights[i].directionType.w != 0.0)
            illuminance = localLight(lighting.lights[i], frame.lightPositions[i], position, toLight);
#endif
        addLight(sums, point, nv, alpha, toLight, illuminance);
    }
    vec3 diffuse = point.diffuse * (1.0 - point.specular) * sums.diffuse;
    vec3 specular = point.specular * (sums.specular - sums.grazing) + sums.grazing;
    return diffuse + specular + environmentLight(point, max(nv, 0.0), occlusion);
}
