// How a lens sample's radiance is stored in its layer.
//
// LAYER_RGB9E5: 9-bit mantissas over a shared 5-bit exponent in 32 bits (as EXT_texture_shared_exponent). A value is rounded
// down after adding the sample's own offset in [0, 1), so that rounding averages out over the samples. 0 means "nothing drawn":
// drawn black still carries an exponent.

#ifdef LAYER_RGB9E5

uint encodeLayer(vec4 color, float ditherOffset) {
    vec3 c = clamp(color.rgb, 0.0, 65000.0);                // NaN becomes 0
    float largest = max(max(c.r, c.g), max(c.b, 3.0517578125e-5));
    int exponent = (floatBitsToInt(largest * (512.0 / 511.0)) >> 23) - 126;  // largest·512/511 < 2^exponent
    float scale = intBitsToFloat((127 + 9 - exponent) << 23);
    ivec3 mantissa = ivec3(c * scale + ditherOffset);   // signed: CPUs convert those in one instruction
    return uint(mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | ((exponent + 15) << 27));
}

vec4 decodeLayer(uint bits) {
    float scale = uintBitsToFloat(((bits >> 27) + uint(127 - 15 - 9)) << 23);
    ivec3 mantissa = ivec3(uvec3(bits, bits >> 9, bits >> 18) & 511u);
    return vec4(vec3(mantissa) * scale, 1.0);
}

#endif

#ifdef LAYER_LARGEST
// Half floats keep 11 bits. How the last is found is the driver's choice, and cutting off darkens every sample a little; so it is
// rounded here, to a value that any conversion keeps.
vec3 roundedToHalf(vec3 color) {
    uvec3 bits = floatBitsToUint(min(color, vec3(LAYER_LARGEST)));
    bits += 0xfffu + ((bits >> 13) & 1u);
    return uintBitsToFloat(bits & ~uvec3(0x1fffu));
}
#endif
