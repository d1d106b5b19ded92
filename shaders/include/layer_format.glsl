// Rounds a lens sample's radiance to the format of its layer.

// Returns the colour clamped to layerLargest and rounded to 11 significant bits, as in half floats. layerLargest = 0:
// layers are 32-bit floats, and the colour is unchanged. Drivers may truncate in conversions to half floats, which
// would darken every sample slightly; the rounded value converts exactly.
vec3 roundedToLayer(vec3 color) {
    if (layerLargest == 0.0) return color;
    uvec3 bits = floatBitsToUint(min(color, vec3(layerLargest)));
    bits += 0xfffu + ((bits >> 13) & 1u);
    return uintBitsToFloat(bits & ~uvec3(0x1fffu));
}
