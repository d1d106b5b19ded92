// Computes the reflectance of a thin film (KHR_materials_iridescence) after Belcour and Barla 2017, A Practical
// Extension to Microfacet Theory for the Modeling of Varying Iridescence, with the equations of the extension's
// specification.

const float filmPi = 3.14159265359;

float schlick(float f0, float cosine) {
    float rest = clamp(1.0 - cosine, 0.0, 1.0);
    float rest2 = rest * rest;
    return f0 + (1.0 - f0) * rest2 * rest2 * rest;
}

vec3 reflectanceBetween(vec3 inner, float outer) {
    vec3 ratio = (inner - outer) / (inner + outer);
    return ratio * ratio;
}

// Returns the eye's response, as linear Rec.709, to an interference wave. It is the Fourier transform of the spectral
// sensitivities, fitted by Gaussians. `path`: difference of the optical paths (nm); `shift`: phase shift.
vec3 waveColor(float path, vec3 shift) {
    float phase = 2.0 * filmPi * path * 1e-9;
    float phase2 = phase * phase;
    vec3 height = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    vec3 position = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);
    vec3 variance = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
    vec3 xyz = height * sqrt(2.0 * filmPi * variance) * cos(position * phase + shift) * exp(-phase2 * variance);
    xyz.x += 9.7470e-14 * sqrt(2.0 * filmPi * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) * exp(-4.5282e+09 * phase2);
    const mat3 rec709 = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252);
    return rec709 * (xyz / 1.0685e-7);
}

// Returns the reflectance of a film in air on a surface with reflectance `base` at normal incidence. `cosine`: cosine
// of the angle of incidence. `thickness`: nm; films below 0.03 nm fade out.
vec3 filmReflectance(float cosine, vec3 base, float filmIor, float thickness) {
    float ior = mix(1.0, filmIor, smoothstep(0.0, 0.03, thickness));
    float inside2 = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
    if (inside2 < 0.0) return vec3(1.0);
    float inside = sqrt(inside2);
    float front = schlick(reflectanceBetween(vec3(ior), 1.0).x, cosine);
    float through = 1.0 - front;                       // product of the amplitudes transmitted into and out of the film
    vec3 root = sqrt(clamp(base, 0.0, 0.9999));
    vec3 baseIor = (1.0 + root) / (1.0 - root);
    vec3 back0 = reflectanceBetween(baseIor, ior);
    vec3 back = vec3(schlick(back0.x, inside), schlick(back0.y, inside), schlick(back0.z, inside));
    // Sum of the phase shifts at the film's two surfaces. Each shift is π if the medium beyond the surface has a lower
    // refractive index than the film, as air always has.
    vec3 shift = filmPi + filmPi * vec3(lessThan(baseIor, vec3(ior)));
    vec3 both = clamp(front * back, 1e-5, 0.9999);
    vec3 several = through * through * back / (1.0 - both);
    vec3 sum = front + several;
    vec3 weight = several - through;
    float path = 2.0 * ior * thickness * inside;
    for (int m = 1; m <= 2; ++m) {
        weight *= sqrt(both);
        sum += weight * 2.0 * waveColor(float(m) * path, float(m) * shift);
    }
    return max(sum, vec3(0.0));
}

// Returns the F0 for which Schlick's approximation gives `reflectance` at the cosine of incidence `cosine`.
vec3 schlickBase(vec3 reflectance, float cosine) {
    float rest = clamp(1.0 - cosine, 0.0, 1.0);
    float grazing = clamp(rest * rest * rest * rest * rest, 0.0, 0.9999);
    return clamp((reflectance - grazing) / (1.0 - grazing), 0.0, 1.0);
}
