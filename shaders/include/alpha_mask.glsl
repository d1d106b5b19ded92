// Tests the cut-outs of glTF's alphaMode MASK. A texel is visible if its alpha is at least the cutoff. Alpha in mip
// levels ≥ 1 is the coverage: the fraction of visible full-size texels (src/render/gpu_scene/cut_out.h). Where such a
// level is read, a lens sample draws the fragment if the coverage exceeds the sample's threshold (alpha_choice.glsl).
// The mean over the samples is therefore the coverage. Magnified textures are read from level 0, so their edges stay
// sharp.

#include "include/alpha_choice.glsl"

#ifdef CHOOSES_BY_ALPHA
// Returns the weight of mip levels ≥ 1 in a texture lookup: 0 if it reads only level 0, 1 if it does not read level 0.
float minification(int unit, int slot, float mipBias) {
    // x: mip level that a lookup without LOD bias would read; y: computed LOD
    vec2 levels = textureQueryLod(materialTextures[unit], uvOf(slot, surface.uv));
    return clamp(min(levels.y + mipBias, levels.x), 0.0, 1.0);
}

// Returns whether the mask hides the fragment. `alpha` is the alpha of the textured colour, and `plainAlpha` is the
// alpha without the texture. `mipBias` is the bias with which the texture was read.
bool maskHides(float alpha, float plainAlpha, uvec2 pixel, float mipBias) {
    float cutoff = material.emissiveCutoff.w;
    if (baseColorTexture.x >= 0) {
        float threshold = max(plainAlpha, 1e-3) * alphaThreshold(pixel);
        cutoff = mix(cutoff, threshold, minification(baseColorTexture.x, baseColorTexture.y, mipBias));
    }
    return alpha < cutoff;
}
#endif
