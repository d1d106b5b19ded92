// The light of a surface towards one lens sample.

#include "include/layer_format.glsl"
#include "include/environment.glsl"
#include "include/surface_fragment.glsl"
#include "include/material_textures.glsl"

#include "include/shading.glsl"
#include "include/surface_shading.glsl"

// Min and max of the vertex colours of the drawn level; used only if levelColorRange.
layout(location = 0) uniform vec4 levelMin;
layout(location = 1) uniform vec4 levelMax;

// Returns the interpolated colour, clamped to the range of the corner values. Rasterizers round corners to a fraction
// of a pixel, so attributes of very narrow triangles are extrapolated far outside that range. Normals need no clamp,
// because only their direction counts. Texture coordinates need none, because steep ones select the smallest mip level.
vec4 surfaceColor() {
    if (colorRanges) return clamp(surface.color, surface.minColor, surface.maxColor);
    if (levelColorRange) return clamp(surface.color, material.baseColor * levelMin, material.baseColor * levelMax);
    return surface.color;
}

vec4 surfaceTexel(int unit, int slot) { return texture(materialTextures[unit], uvOf(slot, surface.uv), wave.mipBias); }

float sampleNumber() { return wave.firstSample + float(gl_Layer); }

bool showsFront() { return gl_FrontFacing; }

float surfaceFootprint(vec3 normal) {
    vec3 right = dFdx(normal);   // interpolated normal only: mip levels average normal maps
    vec3 up = dFdy(normal);
    return dot(right, right) + dot(up, up);
}

// Returns true if this pixel shows the coarser level in a boundary sample, the lens sample that mixes two levels. The
// ordered dither is the R2 sequence x/ρ + y/ρ² modulo 1 with ρ³ = ρ + 1 (Roberts 2018, The Unreasonable Effectiveness
// of Quasirandom Sequences). Integer arithmetic in units of 2⁻³² gives identical results on all devices. The chosen
// pixels are evenly spread, with a different offset for each object.
bool drawsCoarser() {
    uvec2 pixel = uvec2(gl_FragCoord.xy + frame.window.xy);
    uint place = pixel.x * 3242174889u + pixel.y * 2447445414u + uint(object.values.z) * 2654435769u;
    return float(place >> 8) < object.values.y * 16777216.0;
}

// Returns the premultiplied radiance and alpha of this fragment, or discards the fragment.
vec4 surfaceLight() {
    if (coarseShare && !drawsCoarser()) discard;
    if (fineShare && drawsCoarser()) discard;
    vec4 baseColor = texturedColor(surfaceColor());
    if (alphaTested && baseColor.a < material.emissiveCutoff.w) discard;
    vec4 light = vec4(surfaceRadiance(baseColor.rgb), surfaceCoverage);
#ifdef TRANSMISSIVE
    if (alphaBlended) light = mix(texelFetch(backdrop, ivec3(gl_FragCoord.xy, gl_Layer), 0), light, baseColor.a);
#else
    if (alphaBlended) light = vec4(light.rgb * baseColor.a, baseColor.a);
#endif
    return vec4(roundedToLayer(light.rgb), light.a);
}
