// Evaluates KHR_materials_sheen with the distribution and masking of Estevez and Kulla 2017, Production Friendly
// Microfacet Sheen BRDF ("Charlie" sheen). Roughness is clamped to at least 0.1, because smoother sheen would shrink to
// a thin line along the silhouette.

float sheenWidth(float roughness) {
    float bounded = max(roughness, 0.1);
    return bounded * bounded;
}

float sheenMaskingTerm(float x, float width) {
    float sharp = (1.0 - width) * (1.0 - width);
    float a = mix(21.5473, 25.3245, sharp);
    float b = mix(3.82987, 3.32435, sharp);
    float c = mix(0.19823, 0.16801, sharp);
    float d = mix(-1.97760, -1.27393, sharp);
    float e = mix(-4.32054, -4.85967, sharp);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

float sheenMasking(float cosine, float width) {
    return cosine < 0.5 ? exp(sheenMaskingTerm(cosine, width))
                        : exp(2.0 * sheenMaskingTerm(0.5, width) - sheenMaskingTerm(1.0 - cosine, width));
}

// Returns π times the sheen's BRDF D·V for light from the unit direction `toLight`. D is the distribution of normals
// and V the visibility.
float sheenReflectance(SurfacePoint point, float nv, float nl, vec3 toLight) {
    if (nv <= 0.0 || nl <= 0.0) return 0.0;
    float width = sheenWidth(point.sheenRoughness);
    float nh = (nl + nv) * inversesqrt(max(2.0 + 2.0 * dot(toLight, point.toEye), 1e-6));
    float sine2 = max(1.0 - nh * nh, 0.0);
    float distribution = (1.0 + 0.5 / width) * pow(sine2, 0.5 / width);
    float visibility = 1.0 / ((1.0 + sheenMasking(nv, width) + sheenMasking(nl, width)) * (4.0 * nv * nl));
    return distribution * min(visibility, 1.0);
}

// Returns the fraction of a white environment that a white sheen reflects. The logarithm of ∫ D·V·(n·l) dl is
// approximated by a polynomial in n·v and √roughness; for roughness ≥ 0.1 and n·v ≥ 0.035, the error of the fraction is
// at most 0.006.
float sheenAlbedo(float nv, float roughness) {
    vec4 powers = vec4(1.0, nv, nv * nv, nv * nv * nv);
    float root = sqrt(max(roughness, 0.1));
    float sum = dot(powers, vec4(-11.8358700, -107.518277, -146.312225, 359.569550));
    sum = sum * root + dot(powers, vec4(27.0940472, 308.596344, 609.711125, -1247.13415));
    sum = sum * root + dot(powers, vec4(-18.0820503, -335.840337, -884.083694, 1583.08773));
    sum = sum * root + dot(powers, vec4(1.57788676, 172.397419, 534.357691, -866.521923));
    sum = sum * root + dot(powers, vec4(1.00131180, -39.2837169, -113.407941, 170.795295));
    return clamp(exp(sum) - 0.001, 0.0, 1.0);
}

// Returns the fraction of light that the sheen transmits to the layers beneath. `share` is the fraction that a white
// sheen reflects.
float sheenRemaining(SurfacePoint point, float share) {
    return 1.0 - share * max(point.sheen.r, max(point.sheen.g, point.sheen.b));
}
