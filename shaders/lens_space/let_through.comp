// Decides for the records (ray hits) of one cut-out or blended material whether the ray stops at the surface. A ray
// that passes through gets a negative weight, and behind.comp finds its next hit.
//
// A cut-out stops a ray where alpha reaches the cutoff; see alpha_mask.glsl for minified cut-outs. A blended surface of
// opacity α stops the fraction α of all rays, so that the mean over the rays is the blended colour (Enderton, Sintorn,
// Shirley and Luebke 2010, Stochastic Transparency).

#include "include/frame.glsl"
#include "include/lens.glsl"
#include "include/environment.glsl"
#include "lens_space/triangles.glsl"
#include "lens_space/rays.glsl"
#include "lens_space/records.glsl"
#include "lens_space/record_rays.glsl"
#include "lens_space/surface.glsl"
#include "lens_space/hit.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = 4) readonly buffer DrawBlock { Draw draws[]; };
// goOn: number of rays that pass through the surface they hit
layout(std430, binding = 5) buffer CountBlock { uint goOn; };

layout(location = 2) uniform uint group;
layout(location = 3) uniform uint recordCount;
// True in the first pass, which processes all records. Later passes process only records with negative weight: rays
// that passed through their previous hit.
layout(location = 4) uniform bool first;

// Owen-scrambles a number whose bits are reversed (Laine and Karras 2011, Stratified Sampling for Stochastic
// Transparency) with the constants from Burley 2020, Practical Hash-based Owen Scrambling.
uint scrambled(uint reversed, uint seed) {
    reversed ^= reversed * 0x3d20adeau;
    reversed += seed;
    reversed *= (seed >> 16) | 1u;
    reversed ^= reversed * 0x05526c56u;
    reversed ^= reversed * 0x53a22864u;
    return reversed;
}

// Returns the threshold in [0, 1) with which alpha is compared to decide whether ray `number` stops at the triangle. At
// one triangle, the thresholds of a pixel's rays form a shuffled and scrambled van der Corput sequence, so they are
// evenly spread. Thresholds at different triangles are independent.
float thresholdOf(uint number, uvec2 pixel, uint triangle) {
    uint seed = mixedBits(triangle + mixedBits(pixel.x + mixedBits(pixel.y)));
    uint shuffled = bitfieldReverse(scrambled(bitfieldReverse(number), seed));
    uint value = bitfieldReverse(scrambled(shuffled, mixedBits(seed + 1u)));
    return float(value >> 8) / 16777216.0;
}

// Alpha of the base colour, and the mip level from which it is read.
struct Alpha {
    float value;
    float level;
};

// Returns the alpha of the texture at the surface point, or 1 without a texture. `unitAndSlot`: unit and slot of the
// texture of the base colour (material_textures.glsl); a negative unit means no texture.
Alpha textureAlpha(ivec2 unitAndSlot) {
    if (unitAndSlot.x < 0) return Alpha(1.0, 0.0);
    vec2 size = vec2(textureSize(materialTextures[unitAndSlot.x], 0));
    vec2 uv = uvOf(unitAndSlot.y, surface.uv);
    float right = length((uvOf(unitAndSlot.y, surface.uvRight) - uv) * size);
    float up = length((uvOf(unitAndSlot.y, surface.uvUp) - uv) * size);
    float level = log2(max(max(min(right, up), max(right, up) / 8.0), 1.0));
    return Alpha(textureLod(materialTextures[unitAndSlot.x], uv, level).a, level);
}

bool stops(float threshold) {
    Alpha texel = textureAlpha(baseColorTexture);
    float alpha = surface.color.a * texel.value;
    if (!alphaTested) return alpha > threshold;
    // Texels of mip level 0 hold alpha; texels of the other mip levels hold the coverage.
    return alpha >= mix(material.emissiveCutoff.w, max(surface.color.a, 1e-3) * threshold, min(texel.level, 1.0));
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= recordCount) return;
    Record record = records[index];
    if (!first && record.weight >= 0.0) return;
    if (record.triangle == noTriangle || draws[triangles[record.triangle].w].group != group) return;
    uvec2 pixel = pixelOf(record);
    Ray ray = rayOf(numberOf(record), pixel);
    readHit(record.triangle, ray.values.x, lensPointOf(record, ray), placeOf(ray, pixel));
    float threshold = thresholdOf(firstRay + numberOf(record), pixel, record.triangle);
    // All points on a line sample have the same ray index, so thresholdOf() gives them the same threshold. Offset each
    // threshold by the point's position along the line.
    if (lineSamples) threshold = fract(threshold + 7.236 * record.place);
    bool stopped = stops(threshold);
    records[index].weight = stopped ? abs(record.weight) : -abs(record.weight);
    if (!stopped && record.weight != 0.0) atomicAdd(goOn, 1u);
}
