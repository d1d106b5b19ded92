// Computes the radiance of a surface towards the lens point of one lens sample.

#include "include/layer_format.glsl"
#include "include/environment.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"
#include "include/alpha_mask.glsl"

#include "include/shading.glsl"
#include "include/surface_shading.glsl"

// Min (levelMin) and max (levelMax) of the vertex colours of the drawn level; used only if levelColorRange.
layout(location = 0) uniform vec4 levelMin;
layout(location = 1) uniform vec4 levelMax;

// Returns the interpolated colour, clamped to the range of the corner values. Rasterizers round vertex positions to a
// fraction of a pixel, so attributes of very narrow triangles are extrapolated far outside that range. Normals need no
// clamp, because only their direction counts. Texture coordinates need no clamp either, because steep gradients select
// the smallest mip level.
vec4 surfaceColor() {
    if (colorRanges) return clamp(surface.color, surface.minColor, surface.maxColor);
    if (levelColorRange) return clamp(surface.color, material.baseColor * levelMin, material.baseColor * levelMax);
    return surface.color;
}

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv), wave.mipBias); }

bool showsFront() { return gl_FrontFacing; }

void addNormalChanges(inout SurfacePoint point, vec3 normal) {
    // `normal` excludes the normal map, because the mip levels of the map already average its variation.
    point.normalRight = dFdx(normal);
    point.normalUp = dFdy(normal);
}

uvec2 pixelOfImage() { return uvec2(gl_FragCoord.xy + frame.window.xy); }

// Returns true if this pixel draws the coarser level in a boundary sample, the lens sample that mixes two levels.
bool drawsCoarser() { return objectThreshold(pixelOfImage()) < object.values.y; }

vec4 surfaceBase = vec4(0.0);   // base colour of the fragment, set by surfaceLight()

// Returns the premultiplied radiance and alpha of this fragment, or discards the fragment.
vec4 surfaceLight() {
    if (coarseShare && !drawsCoarser()) discard;
    if (fineShare && drawsCoarser()) discard;
    vec4 plainColor = surfaceColor();
    vec4 baseColor = texturedColor(plainColor);
    surfaceBase = baseColor;
#ifdef CHOOSES_BY_ALPHA
    if (alphaTested && maskHides(baseColor.a, plainColor.a, pixelOfImage(), wave.mipBias)) discard;
    if (!alphaTested && !alphaBlended && baseColor.a <= alphaThreshold(pixelOfImage())) discard;
#endif
    vec4 light = vec4(surfaceRadiance(baseColor.rgb), surfaceCoverage);
#ifdef TRANSMISSIVE
    if (alphaBlended) light = mix(texelFetch(backdrop, ivec3(gl_FragCoord.xy, gl_Layer), 0), light, baseColor.a);
#else
    if (alphaBlended) light = vec4(light.rgb * baseColor.a, baseColor.a);
#endif
    return vec4(roundedToLayer(light.rgb), light.a);
}
