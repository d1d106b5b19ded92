// Cut-outs of glTF's alphaMode MASK. A texel is visible if its alpha is at least the cutoff. Alpha in mip levels ≥ 1 of
// the base colour is the coverage: the fraction of visible full-size texels (src/render/gpu_scene/cut_out.h). Where
// such a level is read, a lens sample draws the fragment if the coverage exceeds the sample's dither threshold. The
// mean over the samples is therefore the coverage (Enderton et al. 2010, Stochastic Transparency). Magnified edges stay
// sharp.

// Returns a dither threshold in [0, 1) that is evenly distributed over neighbouring pixels, with a different offset for
// each object, and over the lens samples in each pixel. The pattern is the R2 sequence x/ρ + y/ρ² modulo 1 with
// ρ³ = ρ + 1 (Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences). Integer arithmetic in units of
// 2⁻³² gives identical results on all devices.
float ditherThreshold(uvec2 pixel, float sampleOffset) {
    uint place = pixel.x * 3242174889u + pixel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return fract(float(place >> 8) / 16777216.0 + sampleOffset);
}

// Returns the weight of mip levels ≥ 1 in a texture lookup: 0 if only level 0 is read, 1 if level 0 is not read.
float minification(int unit, int slot, float mipBias) {
    // x: mip level that is read without the bias
    vec2 levels = textureQueryLod(materialTextures[unit], uvOf(slot, surface.uv));
    return clamp(min(levels.y + mipBias, levels.x), 0.0, 1.0);
}

// Returns whether the mask hides the fragment. `alpha` is the alpha of the textured colour, and `plainAlpha` is the
// alpha without the texture. `mipBias` is the bias with which the texture was read.
bool maskHides(float alpha, float plainAlpha, uvec2 pixel, float mipBias) {
    float cutoff = material.emissiveCutoff.w;
    if (baseColorTexture.x >= 0) {
        float threshold = max(plainAlpha, 1e-3) * ditherThreshold(pixel, surface.ditherOffset);
        cutoff = mix(cutoff, threshold, minification(baseColorTexture.x, baseColorTexture.y, mipBias));
    }
    return alpha < cutoff;
}
