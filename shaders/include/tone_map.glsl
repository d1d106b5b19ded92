// Maps linear HDR colours to display values, like src/image/tone_map.cpp. Implements sRGB (IEC 61966-2-1), Stephen
// Hill's fit of ACES, Benjamin Wrensch's fit of Troy Sobotka's AgX with its base look, and Khronos PBR Neutral.

vec3 finiteColour(vec3 value) {
    const float brightest = 1e6;
    return vec3(value.r > 0.0 ? min(value.r, brightest) : 0.0, value.g > 0.0 ? min(value.g, brightest) : 0.0,
                value.b > 0.0 ? min(value.b, brightest) : 0.0);
}

vec3 srgbEncoded(vec3 linear) {
    vec3 v = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}

vec3 srgbDecoded(vec3 encoded) {
    return mix(pow((encoded + 0.055) / 1.055, vec3(2.4)), encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

vec3 acesEncoded(vec3 linear) {
    const mat3 inputMatrix =
        mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 outputMatrix =
        mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = inputMatrix * linear;
    vec3 fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return srgbEncoded(outputMatrix * fitted);
}

vec3 agxEncoded(vec3 linear) {
    const float darkest = -12.47393;   // log2 of the darkest linear value (EV)
    const float lightest = 4.026069;
    const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                            0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
                             1.15190312990417, -0.0980434501171241, -0.0990297440797205, -0.0989611768448433,
                             1.15107367264116);
    vec3 exposure = log2(max(inset * linear, 1e-10));
    vec3 x = clamp((exposure - darkest) / (lightest - darkest), 0.0, 1.0);
    vec3 curve = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
    return clamp(outset * curve, 0.0, 1.0);
}

vec3 neutralEncoded(vec3 v) {
    const float mirrored = 0.04;
    const float kept = 0.8 - mirrored;
    const float left = 1.0 - kept;
    float minimum = min(v.r, min(v.g, v.b));
    v -= minimum < 2.0 * mirrored ? minimum - minimum * minimum / (4.0 * mirrored) : mirrored;
    float peak = max(v.r, max(v.g, v.b));
    if (peak <= kept) return srgbEncoded(v);
    float compressed = 1.0 - left * left / (peak + left - kept);
    float white = 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0);
    return srgbEncoded(mix(v * (compressed / peak), vec3(compressed), white));
}

// Encodes a colour for display. Curve 0: none, 1: ACES, 2: AgX, 3: neutral (the order of the enumeration ToneMap).
vec3 displayEncoded(vec3 linear, float gain, int curve) {
    vec3 colour = finiteColour(gain * linear);
    switch (curve) {
        case 1: return acesEncoded(colour);
        case 2: return agxEncoded(colour);
        case 3: return neutralEncoded(colour);
        default: return srgbEncoded(colour);
    }
}
