// Shades surfaces with glTF 2.0's metallic-roughness model. The diffuse part is Lambert, the specular part GGX (Walter
// et al. 2007) with Schlick's Fresnel and height-correlated Smith masking (Heitz 2014, Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs). The environment's specular part is split into the reflected
// radiance and the directional albedo (Karis 2013, Real Shading in Unreal Engine 4), which is tabulated.
//
// One sample represents an area of the surface, and a normal of a coarse level represents several normals of level 0.
// Both kinds of variation of the normal widen the specular lobe without changing its total energy.
//
// Fresnel is F = F0 + (1 − F0)·g with g = (1 − v·h)⁵. The lights are therefore summed without F0 and albedo
// (LightSums). This sum takes few operations per light, which matters on software rasterizers.

layout(std140, binding = 6) uniform WaveBlock {
    // Side in px of the square over which a texture lookup is filtered. The area of the square is 1/(2N − 1) px², where
    // N is the frame's number of samples per pixel at the end of the current block of samples. The mean over the
    // samples filters the texture over the full pixel. The area is below 1/N, because trilinear lookups cover more than
    // the square.
    float footprint;
    float mipBias;        // log2(footprint), bias on the mip level: without it, OpenGL filters over a full pixel
} wave;

// Directional albedo of the specular part (src/scene/specular_albedo.h).
layout(binding = 33) uniform sampler2D specularAlbedos;

struct SurfacePoint {
    vec3 diffuse;         // albedo of the diffuse part
    vec3 specular;        // reflectance at normal incidence, F0
    float roughness;      // perceptual roughness
    vec3 normal;          // unit vector in world axes, like all directions in this struct
    vec3 toEye;           // unit vector
    vec3 emission;        // emitted radiance; set only if emissive
    vec3 normalRight;     // change in the interpolated normal over one pixel to the right
    vec3 normalUp;        // change in the interpolated normal from a pixel to the pixel above it
    // The next three members are set only if coarseLevel.
    float agreement;      // length |n| of the mean of the unit normals that `normal` represents, in (0, 1]
    float spread;         // spread of the unit normals that `normal` represents, from normalSpread()
    vec3 seen;            // mean of the visible normals, see seenNormal()
    float grazing;        // reflectance at grazing angles, F90; 1 unless the define ownReflectance is set
    vec3 transmitted;     // radiance from behind the surface, not yet reduced by the specular reflectance
    // The next two members are set only if the material has sheen.
    vec3 sheen;           // colour of the sheen
    float sheenRoughness; // perceptual roughness
    // The next three members are set only if the material has clearcoat.
    float coat;           // coated fraction of the surface
    float coatRoughness;  // perceptual roughness
    vec3 coatNormal;      // unit vector
    // The next four members are set only if the material is anisotropic.
    vec3 stretch;         // direction along which highlights are stretched: a unit vector tangent to the surface
    vec3 across;          // unit vector tangent to the surface, perpendicular to `stretch`
    vec2 widths;          // GGX widths α along `stretch` and `across`
    vec3 mirror;          // normal for reflections of the environment
    // The next three members are set only if the material is iridescent (KHR_materials_iridescence).
    float iridescence;    // fraction of the surface that a thin film covers
    float film;           // thickness of the thin film (nm)
    vec3 filmBase;        // F0 for which Schlick's approximation equals the film's reflectance in the view direction
    vec3 through;         // albedo for diffuse light that comes from behind the surface; set only if diffusesThrough
    // Part of the environment's irradiance that occluders block, divided by π. Set only if `shadowed`.
    vec3 hidden;
};

vec3 lightShares[lightCount + 1];   // fraction of each light that reaches the surface; set only if `shadowed`

// Reflected light without the factors F0 and albedo. Σ: sum over all lights. n, l, v, h: unit vectors of the normal,
// the direction to the light, the direction to the eye, and the half vector of l and v. The irradiance of a light is
// n·l times the irradiance of a surface that faces the light. D: distribution of normals. V: visibility, masking /
// (4·(n·l)·(n·v)).
struct LightSums {
    vec3 diffuse;         // diffuse light beneath the Fresnel reflection: Σ irradiance·(1 − g)/π, with g = (1 − v·h)⁵
    vec3 specular;        // specular light for reflectance 1: Σ irradiance·D·V (normal distribution D, visibility V)
    vec3 grazing;         // specular light for reflectance g = (1 − v·h)⁵, Schlick's weight: Σ irradiance·D·V·g
    vec3 matt;            // diffuse light without Fresnel loss: Σ irradiance/π
    vec3 sheen;           // sheen of colour 1: Σ irradiance·D·V, with the sheen's distribution D and visibility V
    // The next two sums are for iridescent surfaces, which a thin film covers.
    vec3 film;            // specular light of the thin film: Σ irradiance·D·V·F, with the film's reflectance F at v·h
    vec3 beneathFilm;     // diffuse light beneath the film: Σ irradiance·(1 − F)/π, F: largest colour channel
    vec3 behind;          // diffuse light from behind: Σ (irradiance of the back side)/π; set only if diffusesThrough
};

// Returns the mean of max(n·l, 0) over the normals n that a coarse level's normal represents. `mean` is the mean of
// n·l, and `cosine` is the cosine between the shading normal and the light. With isotropic spread, the variance of n·l
// is proportional to 1 − cosine². For a Gaussian distribution (μ, σ²), the mean of the positive part is approximately
// (μ + √(μ² + 2σ²/π)) / 2. `spread` is 2σ²/π for light perpendicular to the shading normal.
float meanCosine(float mean, float cosine, float spread) {
    return 0.5 * (mean + sqrt(mean * mean + spread * max(1.0 - cosine * cosine, 0.0)));
}

// Returns the spread S for which the mean of meanCosine() over all light directions is 1/4, as for a single normal. The
// surface then reflects as much light as it receives. S is the solution of |n| + S / √(|n|² − S) · arsinh
// √(|n|²/S − 1) = 1, where |n| is `agreement`. The code approximates S by a polynomial. The error of the mean is 7e-4,
// relative to 1/4.
float normalSpread(float agreement) {
    float lost = 1.0 - agreement;
    float root = sqrt(lost);
    return lost * (0.17796 + root * (1.04019 + root * (-1.37493 + root * (1.28514 - 0.72122 * root))));
}

// Returns the mean of the normals that a coarse level's normal represents, weighted by their visible area, because
// normals that face the eye cover more pixels: Σ n·(n·v) / Σ (n·v), with the direction v to the eye. Seen along the
// mean normal, the weighted mean has the length `agreement`, here a. Seen from other directions, it is tilted towards
// the eye by about (1 − a) / mean(n·v) times the component of v perpendicular to the mean normal. At grazing angles few
// normals are visible, and this tilt would be too large. It is therefore limited to the largest tilt that is possible
// for this a; the limit is fitted to the von Mises–Fisher distribution.
vec3 seenNormal(vec3 normal, vec3 toEye, float agreement, float spread) {
    float nv = dot(normal, toEye);
    float seen = max(meanCosine(agreement * nv, nv, spread), 1e-3);
    float turn = (1.0 - agreement) / seen;
    float bound = 1.23 * turn / ((1.0 + agreement) * seen) * max(1.0 - nv * nv, 0.0);
    return agreement * normal + turn * inversesqrt(1.0 + bound) * (toEye - nv * normal);
}

// Returns 2σ², where σ² is the variance of the slopes of the full-detail normals whose mean is the normal n of a coarse
// level: σ² ≈ (1 − |n|)/|n| (Toksvig 2005, Mipmapping Normal Maps).
float coarseSpread(SurfacePoint point) {
    return 2.0 * (1.0 - point.agreement) / point.agreement;
}

// Variance σ² of the slopes of all normals that a sample represents, in two perpendicular directions along the surface.
struct Spread {
    vec3 axis;            // unit vector along which the slopes have the largest variance; 0 if all directions are equal
    float along;          // 2σ² of the slopes along `axis`
    float across;         // 2σ² of the slopes across `axis`
};

// Variance of the normals within a pixel, which widens highlights. The equations follow Kaplanyan et al. 2016
// (Filtering Distributions of Normals for Shading Antialiasing), with the bound of Tokuyoshi and Kaplanyan 2019
// (Improved Geometric Specular Antialiasing). σ² is the variance of the normals over a square whose area is 8 times the
// area over which a sample's texture lookups are filtered (WaveBlock::footprint), but at most one pixel. The points of
// the square are weighted by a Gaussian whose standard deviation is half the square's side. If the square's area is
// halved, 64 samples miss up to 12 % of the sun's light that a mirror ball reflects, because the ball's highlight is
// far smaller than a pixel. If the area is larger, the additional blur of highlights adds more error than the lower
// noise removes.
//
// The same variance is used in all directions. On a wire, however, normals vary by half a turn across the wire and
// hardly along it. A highlight that is widened along the wire would light parts that face away from the light. Along
// the wire, 2σ² is therefore limited to 0.03 (σ = 7°), unless normals vary more in this direction.
Spread slopeSpread(SurfacePoint point) {
    float right2 = dot(point.normalRight, point.normalRight);
    float up2 = dot(point.normalUp, point.normalUp);
    float product = dot(point.normalRight, point.normalUp);
    float mean = 0.5 * (right2 + up2);
    float difference = 0.5 * (right2 - up2);
    // The matrix of the dot products of normalRight and normalUp has the eigenvalues mean ± deviation.
    float deviation = sqrt(difference * difference + product * product);
    vec3 axis = difference >= 0.0 ? (deviation + difference) * point.normalRight + product * point.normalUp
                                  : product * point.normalRight + (deviation - difference) * point.normalUp;
    axis -= point.normal * dot(point.normal, axis);
    float axis2 = dot(axis, axis);
    float ofEqual = 0.5 * mean;   // 2σ² of the normals over a full pixel, if σ² is the same in all directions
    vec2 ofPixel = vec2(ofEqual, min(ofEqual, max(0.5 * (mean - deviation), 0.03)));
    vec2 spread = min(ofPixel * min(8.0 * wave.footprint * wave.footprint, 1.0), 0.18);
    if (coarseLevel) spread += coarseSpread(point);
    return Spread(axis2 > 1e-20 ? axis * inversesqrt(axis2) : vec3(0.0), spread.x, spread.y);
}

float meanSpread(Spread spread) { return 0.5 * (spread.along + spread.across); }

// Specular lobe of GGX slopes of width α, convolved with a Gaussian distribution of slopes of variance σ². If σ
// dominates, the result is close to Beckmann's distribution, but its far tail remains that of GGX. The model mixes
// Beckmann with weight 2σ² / (α² + 2σ²) and GGX with the rest, both of squared width α² + 2σ². This mix preserves GGX's
// tail α²/(π tan⁴ θ) at large angles θ from the normal. The variance differs along and across an axis (Spread), so
// Beckmann's distribution has two widths. GGX and the weights use the mean of 2σ² over both directions.
//
// Masking: normals that only add to σ belong to other positions in the pixel, or to level 0, and don't mask each other
// like microfacets. Masking therefore uses α. In the Beckmann term, the normals that reflect light point along the half
// vector h, so its masking uses the cosine v·h for both the light and the eye. The GGX term uses n·l and n·v.
//
// Coarse levels: normals that face the eye cover more pixels, so each is weighted by v·h divided by the mean of v·h. In
// the masking of the Beckmann term, the cosine to the eye is therefore this mean. The variance of a coarse level moves
// weight from the GGX term to the Beckmann term, but only the fraction 1 − α of the weight that 2σ² gives above.
struct Lobe {
    float width;          // width α of the GGX distribution of microfacets
    float alpha2;         // squared GGX width α² + 2σ²; σ²: variance of the normals' slopes, mean of both directions
    vec3 axis;            // direction in which the normals' slopes vary more (Spread::axis)
    vec2 widths2;         // squared Beckmann widths α² + 2σ² along and across `axis`; σ²: variance of the slopes
    float share;          // weight of Beckmann's distribution
    // The masking of the Beckmann term uses `shown` + `shownOfH` · (v·h) as the cosine between the view direction v and
    // the reflecting normals; h is the half vector.
    float shown;
    float shownOfH;       // 1 at full detail, where `shown` is 0
};

Lobe lobeOf(SurfacePoint point, float nv, Spread spread) {
    float width = point.roughness * point.roughness;
    float mean = meanSpread(spread);
    float alpha2 = clamp(width * width + mean, 1e-6, 1.0);
    vec2 widths2 = clamp(width * width + vec2(spread.along, spread.across), 1e-6, 1.0);
    if (!coarseLevel) return Lobe(width, alpha2, spread.axis, widths2, min(mean / alpha2, 1.0), 0.0, 1.0);
    float coarse = min(coarseSpread(point) * (1.0 - width) / alpha2, 1.0);
    float share = min(coarse + (mean - coarseSpread(point)) / alpha2, 1.0);
    float ofCoarse = share > 0.0 ? min(coarse / share, 1.0) : 0.0;
    float seen = meanCosine(point.agreement * nv, nv, point.spread);
    return Lobe(width, alpha2, spread.axis, widths2, share, ofCoarse * seen, 1.0 - ofCoarse);
}

// Returns 2·(n·l)·V, where V is the height-correlated Smith visibility of GGX with width α. `nl`, `nv`: cosines n·l and
// n·v between the normal and the directions to the light and to the eye; the result is 0 if one of them is ≤ 0.
// `width2`: α².
float unmasked(float nl, float nv, float width2) {
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    float masking = nl * sqrt(nv * nv * (1.0 - width2) + width2) + nv * sqrt(nl * nl * (1.0 - width2) + width2);
    return nl / max(masking, 1e-4);
}

#include "include/anisotropy.glsl"
#include "include/iridescence.glsl"

float strongest(vec3 color) { return max(color.r, max(color.g, color.b)); }

// Adds a light from the unit direction `toLight` to the sums; `illuminance` is divided by π. The half vector h occurs
// only in cosines: |l + v|² = 2 + 2 l·v, (n·h)² = (n·l + n·v)² / |l + v|², (v·h)² = |l + v|² / 4.
void addLight(inout LightSums sums, SurfacePoint point, float nv, Lobe lobe, vec3 toLight, vec3 illuminance) {
    float cosine = dot(point.normal, toLight);
    float sum2 = max(2.0 + 2.0 * dot(toLight, point.toEye), 1e-6);
    float vh = 0.5 * sqrt(sum2);
    float cosines = max(cosine + nv, 0.0);
    float cosines2 = cosines * cosines;
    float base = max(cosines2 * (lobe.alpha2 - 1.0) + sum2, lobe.alpha2 * sum2);  // the max enforces (n·h)² ≤ 1
    float ggx = lobe.alpha2 / (base * base);
    float away = max(cosines2, 1e-4 * sum2);  // (n·h)²·|l + v|², bounded away from 0
    float slope2 = max(sum2 - away, 0.0);
    float along = dot(lobe.axis, toLight + point.toEye);
    float along2 = min(along * along, slope2);
    float slopes = along2 / lobe.widths2.x + (slope2 - along2) / lobe.widths2.y;
    float beckmann = exp(-slopes / away) * inversesqrt(lobe.widths2.x * lobe.widths2.y) / (away * away);
    float width2 = lobe.width * lobe.width;
    float reflected = mix(ggx * unmasked(cosine, nv, width2), beckmann * unmasked(vh, lobe.shown + lobe.shownOfH * vh, width2), lobe.share);
    float specular = 0.5 * sum2 * sum2 * reflected;
    if (anisotropic && point.widths.x > 0.0)
        specular = anisotropicReflection(point, cosine, nv, max(lobe.alpha2 - width2, 0.0), toLight);
    float g = 1.0 - vh;
    float g2 = g * g;
    g = g2 * g2 * g;
    float matt = coarseLevel ? meanCosine(dot(point.seen, toLight), cosine, point.spread) : max(cosine, 0.0);
    sums.diffuse += illuminance * (matt * (1.0 - g));
    sums.matt += illuminance * matt;
    vec3 received = illuminance * specular;
    sums.specular += received;
    sums.grazing += received * g;
    if (iridescent && point.iridescence > 0.0) {
        vec3 reflectance = filmReflectance(vh, point.specular, material.film.y, point.film);
        sums.film += received * reflectance;
        sums.beneathFilm += illuminance * (matt * (1.0 - strongest(reflectance)));
    }
    if (diffusesThrough)
        sums.behind += illuminance * (coarseLevel ? meanCosine(-dot(point.seen, toLight), cosine, point.spread) : max(-cosine, 0.0));
}

// Returns the illuminance over π that the surface position `position` receives from a point or spot light
// (KHR_lights_punctual), and sets the unit vector `toLight`. `positionRange`: position and range of the light; range 0
// is unlimited.
vec3 localLight(LightData light, vec4 positionRange, vec3 position, out vec3 toLight) {
    vec3 offset = positionRange.xyz - position;
    float distance2 = max(dot(offset, offset), 1e-8);
    toLight = offset * inversesqrt(distance2);
    float falloff = 1.0 / distance2;
    // Attenuates the light towards its range, as KHR_lights_punctual recommends.
    if (positionRange.w > 0.0) {
        float ratio2 = distance2 / (positionRange.w * positionRange.w);
        falloff *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    }
    if (light.directionType.w == 2.0) {
        float cone = clamp(dot(light.directionType.xyz, -toLight) * light.colorScale.w + light.cone.x, 0.0, 1.0);
        falloff *= cone * cone;
    }
    return light.colorScale.rgb * falloff;
}

// Returns the normal for diffuse lighting by the environment.
vec3 mattNormal(SurfacePoint point) { return coarseLevel ? point.seen : point.normal; }

// Returns (x, y) such that the specular part reflects the fraction x·F0 + y·F90 of a white environment.
vec2 specularAlbedos2(SurfacePoint point, float nv) {
    float roughness = anisotropic && point.widths.x > 0.0 ? isotropicRoughness(point) : point.roughness;
    vec2 size = vec2(textureSize(specularAlbedos, 0));
    vec2 place = (vec2(sqrt(nv), roughness) * (size - 1.0) + 0.5) / size;
    return textureLod(specularAlbedos, place, 0.0).xy;
}

// Returns F0, including the effect of an iridescent surface's film.
vec3 reflectanceOf(SurfacePoint point) {
    return iridescent ? mix(point.specular, point.filmBase, point.iridescence) : point.specular;
}

// Returns the factor by which single scattering is multiplied to include multiple scattering (Turquin 2019, Practical
// Multiple Scattering Compensation for Microfacet Models). `albedo`: result of specularAlbedos2(), whose x + y is the
// directional albedo for reflectance 1.
vec3 severalReflections(vec3 specular, vec2 albedo) {
    return 1.0 + specular * (1.0 / max(albedo.x + albedo.y, 0.1) - 1.0);
}

// Returns the fraction of a white environment that the specular part reflects.
vec3 specularAlbedo(SurfacePoint point, float nv) {
    vec2 albedo = specularAlbedos2(point, nv);
    vec3 several = multipleScattering ? severalReflections(reflectanceOf(point), albedo) : vec3(1.0);
    if (ownReflectance) albedo.y *= point.grazing;
    vec3 reflected = reflectanceOf(point) * albedo.x + albedo.y;
    return multipleScattering ? reflected * several : reflected;
}

// Returns the fraction of light left for the layers beneath a layer that reflects `reflected`. For coloured
// reflections, the strongest channel is used, so that the layers beneath don't get the complementary colour
// (KHR_materials_specular).
vec3 remaining(vec3 reflected) {
    return ownReflectance || iridescent ? vec3(1.0 - strongest(reflected)) : 1.0 - reflected;
}

#include "include/sheen.glsl"

// Returns the radiance that the surface reflects from the environment towards the eye, scaled by `occlusion`. The
// diffuse part receives only light that the specular part doesn't reflect.
vec3 environmentLight(SurfacePoint point, float nv, float spread, float occlusion) {
    if (environmentType == 0) return vec3(0.0);
    vec3 diffuse;
    vec3 behind;
    vec3 reflection;
    if (environmentType == 3) {
        diffuse = environmentDiffuse(mattNormal(point));
        if (diffusesThrough) behind = environmentDiffuse(-mattNormal(point));
        float width = point.roughness * point.roughness;
        float roughness = sqrt(sqrt(min(width * width + spread, 1.0)));
        reflection = environmentRadiance(reflect(-point.toEye, anisotropic ? point.mirror : point.normal), roughness * environmentLevels);
    } else if (environmentType == 2) {
        // The radiance of a gradient environment depends only on the height (y) of a direction, here of the mirrored
        // direction 2 (n·v) n − v. The spread of the normals scales the mean height of mirrored directions by
        // 1 − 2·spread. Diffuse reflection scales the height by 2/3, so mixing in the fraction 6·spread of diffuse
        // light gives the same mean height.
        float mirroredHeight = anisotropic ? reflect(-point.toEye, point.mirror).y : 2.0 * nv * point.normal.y - point.toEye.y;
        diffuse = gradientDiffuse(mattNormal(point).y);
        if (diffusesThrough) behind = gradientDiffuse(-mattNormal(point).y);
        reflection = mix(gradientRadiance(mirroredHeight), gradientDiffuse(mirroredHeight), min(point.roughness + 6.0 * spread, 1.0));
    } else {
        diffuse = lighting.environment[0].rgb;
        reflection = diffuse;
        behind = diffuse;
    }
    if (shadowed) diffuse -= point.hidden;
    vec3 specular = specularAlbedo(point, nv);
    vec3 light = point.diffuse * remaining(specular) * diffuse + specular * reflection;
    if (diffusesThrough) light += point.through * remaining(specular) * behind;
    if (sheen) {
        float sheenShare = sheenAlbedo(nv, point.sheenRoughness);
        light = light * sheenRemaining(point, sheenShare) + point.sheen * sheenShare * diffuse;
    }
    return light * (occlusion * environmentLighting);
}

// Returns the radiance towards the eye without the clear coat. `position` (relative to the camera, in m, world axes) is
// used only for point and spot lights. `occlusion` scales the environment's light.
vec3 uncoatedRadiance(SurfacePoint point, vec3 position, float occlusion) {
    float nv = dot(point.normal, point.toEye);   // may be negative: an interpolated normal can face away
    Spread spread = slopeSpread(point);
    Lobe lobe = lobeOf(point, nv, spread);
    LightSums sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float sheenToEye = sheen ? sheenAlbedo(max(nv, 0.0), point.sheenRoughness) : 0.0;
    for (int i = 0; i < lightCount; ++i) {
        vec3 toLight = -lighting.lights[i].directionType.xyz;
        vec3 illuminance = lighting.lights[i].colorScale.rgb;
        if (localLights && lighting.lights[i].directionType.w != 0.0)
            illuminance = localLight(lighting.lights[i], frame.lightPositions[i], position, toLight);
        if (shadowed) illuminance *= lightShares[i];
        if (sheen) {
            float nl = max(dot(point.normal, toLight), 0.0);
            sums.sheen += illuminance * (nl * sheenReflectance(point, nv, nl, toLight));
            illuminance *= sheenRemaining(point, max(sheenToEye, sheenAlbedo(nl, point.sheenRoughness)));
        }
        addLight(sums, point, nv, lobe, toLight, illuminance);
    }
    vec3 diffuse = point.diffuse * (1.0 - point.specular) * sums.diffuse;
    vec3 specular = point.specular * (sums.specular - sums.grazing) + sums.grazing;
    if (ownReflectance) {
        // Schlick: F = F0 + (F90 − F0)·g with g = (1 − cos θ)⁵, so 1 − F = (1 − F90) + (F90 − F0)·(1 − g).
        specular = point.specular * (sums.specular - sums.grazing) + point.grazing * sums.grazing;
        diffuse = point.diffuse * ((1.0 - point.grazing) * sums.matt + (point.grazing - strongest(point.specular)) * sums.diffuse);
    }
    if (iridescent) {
        specular = mix(specular, sums.film, point.iridescence);
        diffuse = mix(diffuse, point.diffuse * sums.beneathFilm, point.iridescence);
    }
    if (diffusesThrough) diffuse += point.through * remaining(specularAlbedo(point, max(nv, 0.0))) * sums.behind;
    if (multipleScattering) specular *= severalReflections(reflectanceOf(point), specularAlbedos2(point, max(nv, 0.0)));
    vec3 radiance = diffuse + specular + environmentLight(point, max(nv, 0.0), meanSpread(spread), occlusion);
    if (transmissive) {
        vec3 transmitted = point.transmitted * remaining(specularAlbedo(point, max(nv, 0.0)));
        radiance += sheen ? transmitted * sheenRemaining(point, sheenToEye) : transmitted;
    }
    if (sheen) radiance += point.sheen * sums.sheen;
    if (emissive) radiance += point.emission;
    return radiance;
}

// Returns the radiance towards the eye, with the clear coat of KHR_materials_clearcoat. The coat, of refractive index
// 1.5, reflects a part of the light and transmits the rest to and from the surface beneath.
vec3 radianceOf(SurfacePoint point, vec3 position, float occlusion) {
    if (!clearcoat) return uncoatedRadiance(point, position, occlusion);
    SurfacePoint coat = point;
    coat.diffuse = vec3(0.0);
    coat.specular = vec3(0.04);
    coat.roughness = point.coatRoughness;
    coat.normal = point.coatNormal;
    coat.emission = vec3(0.0);
    coat.grazing = 1.0;
    coat.transmitted = vec3(0.0);
    coat.sheen = vec3(0.0);
    coat.widths = vec2(0.0);
    coat.mirror = coat.normal;
    coat.iridescence = 0.0;
    coat.through = vec3(0.0);
    vec3 share = point.coat * specularAlbedo(coat, max(dot(coat.normal, coat.toEye), 0.0));
    return uncoatedRadiance(point, position, occlusion) * (1.0 - share) + point.coat * uncoatedRadiance(coat, position, occlusion);
}
