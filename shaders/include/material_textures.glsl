// Textures of the material. The array materialTextures holds only textures that the material uses. textureUnits[slot]
// is the index in this array for a slot (base colour, normal, …), or −1 if the material has no texture for it.

layout(binding = 8) uniform sampler2D materialTextures[textureCount];

// x: index in materialTextures, or −1; y: slot, in the order of textureUses() in src/scene/scene.h.
const ivec2 baseColorTexture = ivec2(textureUnits[0], 0);
const ivec2 metallicRoughnessTexture = ivec2(textureUnits[1], 1);
const ivec2 normalTexture = ivec2(textureUnits[2], 2);
const ivec2 occlusionTexture = ivec2(textureUnits[3], 3);
const ivec2 emissiveTexture = ivec2(textureUnits[4], 4);
const ivec2 specularTexture = ivec2(textureUnits[5], 5);
const ivec2 specularColorTexture = ivec2(textureUnits[6], 6);
const ivec2 transmissionTexture = ivec2(textureUnits[7], 7);
const ivec2 thicknessTexture = ivec2(textureUnits[8], 8);
const ivec2 clearcoatTexture = ivec2(textureUnits[9], 9);
const ivec2 clearcoatRoughnessTexture = ivec2(textureUnits[10], 10);
const ivec2 clearcoatNormalTexture = ivec2(textureUnits[11], 11);
const ivec2 sheenColorTexture = ivec2(textureUnits[12], 12);
const ivec2 sheenRoughnessTexture = ivec2(textureUnits[13], 13);
const ivec2 anisotropyTexture = ivec2(textureUnits[14], 14);
const ivec2 iridescenceTexture = ivec2(textureUnits[15], 15);
const ivec2 iridescenceThicknessTexture = ivec2(textureUnits[16], 16);
const ivec2 diffuseTransmissionTexture = ivec2(textureUnits[17], 17);
const ivec2 diffuseTransmissionColorTexture = ivec2(textureUnits[18], 18);

// Returns the texture coordinates of texture slot `slot`. `uvSets` holds both UV sets of the surface.
vec2 uvOf(int slot, vec4 uvSets) {
#ifdef UV_TRANSFORMS
    vec4 rowU = material.uvRows[2 * slot];
    vec4 rowV = material.uvRows[2 * slot + 1];
    vec2 uv = rowU.w == 0.0 ? uvSets.xy : uvSets.zw;
    return vec2(dot(rowU.xyz, vec3(uv, 1.0)), dot(rowV.xyz, vec3(uv, 1.0)));
#else
    return uvSets.xy;
#endif
}

// Returns a sample of materialTextures[unit] at uvOf(slot, …), filtered over the part of the pixel that the lens sample
// represents. Each file that includes this one defines the function.
vec4 surfaceTexel(int unit, int slot);

// Returns the value of a texture in this pixel, or white if the material has no such texture.
vec4 materialTexel(ivec2 unitAndSlot) {
    if (unitAndSlot.x < 0) return vec4(1.0);
    return surfaceTexel(unitAndSlot.x, unitAndSlot.y);
}

vec4 texturedColor(vec4 baseColor) { return baseColor * materialTexel(baseColorTexture); }
