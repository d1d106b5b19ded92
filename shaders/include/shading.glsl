// glTF 2.0 metallic-roughness: Lambert and GGX (Walter et al. 2007) with Hammon's fit (2017, PBR Diffuse Lighting for GGX+Smith
// Microsurfaces) of the height-correlated Smith masking and Schlick's Fresnel; the environment's specular part by Karis's fit
// (2014, Physically Based Shading on Mobile).
//
// One sample stands for a piece of the surface, and a normal of a coarse level for those of level 0: what either spreads is
// added to the width of the lobe, and neither changes how much light the lobe holds. SAMPLE_NUMBER says which sample of the frame it is.
//
// Fresnel is F = F0 + (1 − F0)·g with g = (1 − v·h)⁵, so the lights can be summed before F0 and the albedo are known: three sums,
// and few operations a light (software rasterisers feel each one).

layout(std140, binding = 6) uniform WaveBlock {
    float firstSample;    // numbers in the whole frame: of the wave's first sample,
    float firstOfBlock;   // and of the first in its block of the sum
} wave;

struct SurfacePoint {
    vec3 diffuse;         // albedo of the diffuse part
    vec3 specular;        // reflectance at normal incidence, F0
    float roughness;      // perceptual
    vec3 normal;          // unit, along the world's axes as all directions here
    vec3 toEye;           // unit
#ifdef EMISSIVE
    vec3 emission;
#endif
    float footprint;      // Σ |∂n|² of the surface's own normal over a step of one pixel to the right and one up
#ifdef COARSE_LEVEL
    float agreement;      // length |n| of the mean of the normals that `normal` stands for, in (0, 1]
    float spread;         // normalSpread()
    vec3 seen;            // seenNormal()
#endif
#ifdef OWN_REFLECTANCE
    float grazing;        // reflectance along the surface, F90; else it is 1
#endif
#ifdef TRANSMISSION
    vec3 transmitted;     // radiance from behind of which the surface lets through what it doesn't reflect
#endif
#ifdef SHEEN
    vec3 sheen;
    float sheenRoughness; // perceptual
#endif
#ifdef CLEARCOAT
    float coat;           // share of the surface that is coated
    float coatRoughness;  // perceptual
    vec3 coatNormal;      // unit
#endif
#ifdef SHADOWS
    float lightShares[LIGHT_COUNT + 1];   // of each light, what reaches the point
    vec3 hidden;          // irradiance over π of the surroundings that doesn't
#endif
};

struct LightSums {
    vec3 diffuse;         // Σ E·(n·l)·(1 − g) / π
    vec3 specular;        // Σ E·(n·l)·D·V
    vec3 grazing;         // Σ E·(n·l)·D·V·g
#ifdef OWN_REFLECTANCE
    vec3 matt;            // Σ E·(n·l) / π
#endif
#ifdef SHEEN
    vec3 sheen;           // Σ E·(n·l)·D·V of the sheen's own lobe
#endif
};

#ifdef COARSE_LEVEL
// The mean of max(n·l, 0) over the normals that one stands for, whose cosine to the light is `cosine`. They have the mean `mean`
// and, if they spread alike to all sides, a variance that falls with 1 − cosine². For a normal distribution of mean μ and variance σ² the
// mean of the positive part is close to (μ + √(μ² + 2σ²/π)) / 2. `spread` is 2σ²/π of a light from the side.
float meanCosine(float mean, float cosine, float spread) {
    return 0.5 * (mean + sqrt(mean * mean + spread * max(1.0 - cosine * cosine, 0.0)));
}

// The spread S at which the mean over all lights is that of one normal, 1/4, so that the piece throws back as much light as it receives:
// |n| + S / √(|n|² − S) · arsinh √(|n|²/S − 1) = 1. The fit is good to 7e-4 of that mean.
float normalSpread(float agreement) {
    float lost = 1.0 - agreement;
    float root = sqrt(lost);
    return lost * (0.17796 + root * (1.04019 + root * (-1.37493 + root * (1.28514 - 0.72122 * root))));
}

// The mean of the normals as they are seen: those that look to the eye cover more of the picture. |n| counts them as they are seen from
// straight above. Seen from elsewhere, the mean of n (n·v) / (n·v) has 1 − |n| of what is across the normal, about; along the surface,
// where few are seen, it can't be longer than what |n| leaves; the bound is fitted to von Mises' and Fisher's distribution.
vec3 seenNormal(vec3 normal, vec3 toEye, float agreement, float spread) {
    float nv = dot(normal, toEye);
    float seen = max(meanCosine(agreement * nv, nv, spread), 1e-3);
    float turn = (1.0 - agreement) / seen;
    float bound = 1.23 * turn / ((1.0 + agreement) * seen) * max(1.0 - nv * nv, 0.0);
    return agreement * normal + turn * inversesqrt(1.0 + bound) * (toEye - nv * normal);
}

// 2σ² for the slopes of the normals that one stands for: σ² ≈ (1 − |n|)/|n| (Toksvig 2005, Mipmapping Normal Maps).
float coarseSpread(SurfacePoint point) {
    return 2.0 * (1.0 - point.agreement) / point.agreement;
}
#endif

// 2σ² for normals whose slopes have the variance σ² along each axis: the mean square of the angles by which they differ.
//
// Of the places in a pixel that one sample stands for, as Kaplanyan et al. 2016 (Filtering Distributions of Normals for Shading
// Antialiasing) and with the bound of Tokuyoshi and Kaplanyan 2019 (Improved Geometric Specular Antialiasing). Sample n has the share
// 1/(n + 1) of a pixel, whose places have a normal distribution as wide as half of it. A lobe that is narrower than the pixel's normals
// vary would still make single white pixels of few samples: it is made as wide as that in the first block, and as a share of it in the
// next ones. Both depend on the sample's number alone, so that blocks add up to the image that is drawn at once, and vanish as samples
// grow, so that highlights converge to what the surface reflects. It falls with the square of the pixel's size, and is 0 on flat surfaces.
float slopeSpread(SurfacePoint point) {
    float ofPixel = 0.25 * point.footprint;
    float ofBlock = min(ofPixel / (wave.firstOfBlock / float(BLOCK_SAMPLES) + 1.0), 0.18);
    float width = point.roughness * point.roughness;
    float ofSample = min(ofPixel / (SAMPLE_NUMBER + 1.0), 0.18);
    float spread = max(ofBlock - width * width, ofSample);
#ifdef COARSE_LEVEL
    spread += coarseSpread(point);
#endif
    return spread;
}

// Slopes that follow GGX of width α, each of them spread once more by a normal distribution of variance σ². Where the spread is the
// wider of the two the sum is close to Beckmann's distribution, but far out, where that has nothing, it is what GGX was. With the
// share 2σ² / (α² + 2σ²) of Beckmann's and the rest of GGX, both of width² α² + 2σ², it keeps all of GGX's tail, α²/(π tan⁴).
//
// What shines within the spread has the normal h, and is seen: those normals are of places in the pixel, or of level 0, which don't mask
// each other as microfacets do. So masking is that of α, and for the spread's share the cosines are those of h, both v·h.
//
// Of a coarse level's normals, those that look to the eye cover more of the picture: each counts v·h times, over the mean of that. So
// their cosine is the mean, as n·v is that of microfacets. Where the microfacets themselves are wide, α of them shine off what they
// stand on, masked as ever.
struct Lobe {
    float width;          // α
    float alpha;          // √(α² + 2σ²)
    float spread;         // its share, which is Beckmann's
    float shown;          // the cosine to the eye is this
    float shownOfH;       // and so much of v·h
};

Lobe lobeOf(SurfacePoint point, float nv, float spread) {
    float width = point.roughness * point.roughness;
    float alpha2 = clamp(width * width + spread, 1e-6, 1.0);
#ifdef COARSE_LEVEL
    float coarse = min(coarseSpread(point) * (1.0 - width) / alpha2, 1.0);
    float share = min(coarse + (spread - coarseSpread(point)) / alpha2, 1.0);
    float seen = meanCosine(point.agreement * nv, nv, point.spread);
    return Lobe(width, sqrt(alpha2), share, (1.0 - share) * nv + coarse * seen, share - coarse);
#else
    float share = min(spread / alpha2, 1.0);
    return Lobe(width, sqrt(alpha2), share, (1.0 - share) * nv, share);
#endif
}

// One light of illuminance `illuminance` (over π) from the unit direction `toLight`. The half vector is known through its cosines
// only: |l + v|² = 2 + 2 l·v, (n·h)² = (n·l + n·v)² / |l + v|², (v·h)² = |l + v|² / 4.
void addLight(inout LightSums sums, SurfacePoint point, float nv, Lobe lobe, vec3 toLight, vec3 illuminance) {
    float cosine = dot(point.normal, toLight);
    float sum2 = max(2.0 + 2.0 * dot(toLight, point.toEye), 1e-6);
    float vh = 0.5 * sqrt(sum2);
    float cosines = max(cosine + nv, 0.0);
    float cosines2 = cosines * cosines;
    float alpha2 = lobe.alpha * lobe.alpha;
    float base = max(cosines2 * (alpha2 - 1.0) + sum2, alpha2 * sum2);  // (n·h)² ≤ 1
    float ggx = alpha2 / (base * base);
    float away = max(cosines2, 1e-4 * sum2);  // not along the surface
    float beckmann = exp(-max(sum2 - away, 0.0) / (away * alpha2)) / (alpha2 * away * away);
    float distribution = sum2 * sum2 * mix(ggx, beckmann, lobe.spread);
    float shownL = max(mix(cosine, vh, lobe.spread), 0.0);   // of the normals that shine
    float shownV = max(lobe.shown + lobe.shownOfH * vh, 0.0);   // averted ones reflect nothing
    float masking = max(mix(2.0 * shownL * shownV, shownL + shownV, lobe.width), 1e-4);
    float specular = shownV > 0.0 ? 0.5 * shownL * distribution / masking : 0.0;
    float g = 1.0 - vh;
    float g2 = g * g;
    g = g2 * g2 * g;
#ifdef COARSE_LEVEL
    float matt = meanCosine(dot(point.seen, toLight), cosine, point.spread);
#else
    float matt = max(cosine, 0.0);
#endif
    sums.diffuse += illuminance * (matt * (1.0 - g));
#ifdef OWN_REFLECTANCE
    sums.matt += illuminance * matt;
#endif
    vec3 received = illuminance * specular;
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
    return point.seen;
#else
    return point.normal;
#endif
}

// The share of a white environment's light that the specular part throws back. The fit leaves [0, 1] for rough surfaces without
// reflectance and at grazing angles.
vec3 specularAlbedo(SurfacePoint point, float nv) {
    vec4 r = point.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 fit = vec2(-1.04, 1.04) * a + r.zw;
#ifdef OWN_REFLECTANCE
    fit.y *= point.grazing;
#endif
    return clamp(point.specular * fit.x + fit.y, 0.0, 1.0);
}

// What a surface that throws back `reflected` leaves to what lies beneath. Of coloured reflections the strongest channel counts, or
// what is beneath would take on the opposite colour (KHR_materials_specular).
vec3 remaining(vec3 reflected) {
#ifdef OWN_REFLECTANCE
    return vec3(1.0 - max(reflected.r, max(reflected.g, reflected.b)));
#else
    return 1.0 - reflected;
#endif
}

#ifdef SHEEN
#include "include/sheen.glsl"
#endif

// The environment's light on the point, `occlusion` of it. What the specular part throws back never reaches the diffuse one.
vec3 environmentLight(SurfacePoint point, float nv, float spread, float occlusion) {
#if ENVIRONMENT == 0
    return vec3(0.0);
#else
#if ENVIRONMENT == 3
    vec3 diffuse = environmentDiffuse(mattNormal(point));
    float width = point.roughness * point.roughness;
    float roughness = sqrt(sqrt(min(width * width + spread, 1.0)));
    vec3 reflection = environmentRadiance(reflect(-point.toEye, point.normal), roughness * ENVIRONMENT_LEVELS);
#elif ENVIRONMENT == 2
    // Only heights count: that of the mirrored direction 2 (n·v) n − v too. Mirrored directions about one spread twice as far as the
    // normals do, so that their mean height is 1 − 2·spread of its height; of the matt reflection it is 2/3.
    float mirroredHeight = 2.0 * nv * point.normal.y - point.toEye.y;
    vec3 diffuse = gradientDiffuse(mattNormal(point).y);
    vec3 reflection = mix(gradientRadiance(mirroredHeight), gradientDiffuse(mirroredHeight), min(point.roughness + 6.0 * spread, 1.0));
#else
    vec3 diffuse = lighting.environment[0].rgb;
    vec3 reflection = diffuse;
#endif
#ifdef SHADOWS
    diffuse -= point.hidden;
#endif
    vec3 specular = specularAlbedo(point, nv);
    vec3 light = point.diffuse * remaining(specular) * diffuse + specular * reflection;
#ifdef SHEEN
    float sheenShare = sheenAlbedo(nv, point.sheenRoughness);
    light = light * sheenRemaining(point, sheenShare) + point.sheen * sheenShare * diffuse;
#endif
    return light * (occlusion * ENVIRONMENT_LIGHTING);
#endif
}

// Radiance towards the eye from beneath a coat. `position`, from the camera, matters to point and spot lights only.
vec3 uncoatedRadiance(SurfacePoint point, vec3 position, float occlusion) {
    float nv = dot(point.normal, point.toEye);   // may be below 0: an interpolated normal can look away
    float spread = slopeSpread(point);
    Lobe lobe = lobeOf(point, nv, spread);
    LightSums sums;
    sums.diffuse = sums.specular = sums.grazing = vec3(0.0);
#ifdef OWN_REFLECTANCE
    sums.matt = vec3(0.0);
#endif
#ifdef SHEEN
    sums.sheen = vec3(0.0);
    float sheenToEye = sheenAlbedo(max(nv, 0.0), point.sheenRoughness);
#endif
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        vec3 toLight = -lighting.lights[i].directionType.xyz;
        vec3 illuminance = lighting.lights[i].colorScale.rgb;
#ifdef LOCAL_LIGHTS
        if (lighting.lights[i].directionType.w != 0.0)
            illuminance = localLight(lighting.lights[i], frame.lightPositions[i], position, toLight);
#endif
#ifdef SHADOWS
        illuminance *= point.lightShares[i];
#endif
#ifdef SHEEN
        float nl = max(dot(point.normal, toLight), 0.0);
        sums.sheen += illuminance * (nl * sheenReflectance(point, nv, nl, toLight));
        illuminance *= sheenRemaining(point, max(sheenToEye, sheenAlbedo(nl, point.sheenRoughness)));
#endif
        addLight(sums, point, nv, lobe, toLight, illuminance);
    }
#ifdef OWN_REFLECTANCE
    // 1 − F = (1 − F90) + (F90 − F0)·(1 − g)
    vec3 specular = point.specular * (sums.specular - sums.grazing) + point.grazing * sums.grazing;
    float strongest = max(point.specular.r, max(point.specular.g, point.specular.b));
    vec3 diffuse = point.diffuse * ((1.0 - point.grazing) * sums.matt + (point.grazing - strongest) * sums.diffuse);
#else
    vec3 diffuse = point.diffuse * (1.0 - point.specular) * sums.diffuse;
    vec3 specular = point.specular * (sums.specular - sums.grazing) + sums.grazing;
#endif
    vec3 radiance = diffuse + specular + environmentLight(point, max(nv, 0.0), spread, occlusion);
#ifdef TRANSMISSION
    vec3 transmitted = point.transmitted * remaining(specularAlbedo(point, max(nv, 0.0)));
#ifdef SHEEN
    transmitted *= sheenRemaining(point, sheenToEye);
#endif
    radiance += transmitted;
#endif
#ifdef SHEEN
    radiance += point.sheen * sums.sheen;
#endif
#ifdef EMISSIVE
    radiance += point.emission;
#endif
    return radiance;
}

#ifdef CLEARCOAT
// KHR_materials_clearcoat: a coat of refractive index 1.5 mirrors, and what it doesn't throw back comes from beneath.
vec3 radianceOf(SurfacePoint point, vec3 position, float occlusion) {
    SurfacePoint coat = point;
    coat.diffuse = vec3(0.0);
    coat.specular = vec3(0.04);
    coat.roughness = point.coatRoughness;
    coat.normal = point.coatNormal;
#ifdef EMISSIVE
    coat.emission = vec3(0.0);
#endif
#ifdef OWN_REFLECTANCE
    coat.grazing = 1.0;
#endif
#ifdef TRANSMISSION
    coat.transmitted = vec3(0.0);
#endif
#ifdef SHEEN
    coat.sheen = vec3(0.0);
#endif
    vec3 share = point.coat * specularAlbedo(coat, max(dot(coat.normal, coat.toEye), 0.0));
    return uncoatedRadiance(point, position, occlusion) * (1.0 - share) + point.coat * uncoatedRadiance(coat, position, occlusion);
}
#else
vec3 radianceOf(SurfacePoint point, vec3 position, float occlusion) {
    return uncoatedRadiance(point, position, occlusion);
}
#endif
