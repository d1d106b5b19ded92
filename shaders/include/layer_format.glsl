// Rounding of a lens sample's radiance to the format of its layer.

#ifdef LAYER_LARGEST
// Rounds to a half float with 11 significant bits. The rounding mode of conversions depends on the driver, and
// truncation would darken every sample slightly. The rounded value is exact in any conversion.
vec3 roundedToHalf(vec3 color) {
    uvec3 bits = floatBitsToUint(min(color, vec3(LAYER_LARGEST)));
    bits += 0xfffu + ((bits >> 13) & 1u);
    return uintBitsToFloat(bits & ~uvec3(0x1fffu));
}
#endif
