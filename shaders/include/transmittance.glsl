// Computes the amount and colour of the light that a material transmits (KHR_materials_transmission and
// KHR_materials_volume).

// Returns the thickness of the volume behind the surface in m; 0 for a thin wall.
float volumeThickness() {
    float scale = pow(abs(determinant(mat3(object.viewFromObject))), 1.0 / 3.0);
    return scale * material.transmission.y * materialTexel(thicknessTexture).g;
}

// Returns the fraction of light that the surface transmits, without the colour of the material.
float transmittedShare(float metallic) {
    return (1.0 - metallic) * material.transmission.x * materialTexel(transmissionTexture).r;
}

// Returns the colour of transmitted light after a path of `way` m through the volume, by Beer–Lambert absorption.
vec3 transmittedTint(vec3 baseColor, float way) { return baseColor * exp(-material.absorption.rgb * way); }
