// Rounding of a lens sample's radiance to the format of its layer.

// Rounds to a half float with 11 significant bits, up to layerLargest; 0: layers of 32-bit floats. The rounding mode of
// conversions depends on the driver, and truncation would darken every sample slightly. The rounded value is exact in
// any conversion.
vec3 roundedToLayer(vec3 color) {
    if (layerLargest == 0.0) return color;
    uvec3 bits = floatBitsToUint(min(color, vec3(layerLargest)));
    bits += 0xfffu + ((bits >> 13) & 1u);
    return uintBitsToFloat(bits & ~uvec3(0x1fffu));
}
